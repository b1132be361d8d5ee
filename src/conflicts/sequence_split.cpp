// SPDX-License-Identifier: MIT
// Splitting a sequence class (Lawler 1972, as in the paper's K-best sequences, but on a node of the
// constraint tree and where a conflict asks for it).
//
//   kStopIs:    the next stop counted is the one that the agent now goes to;
//   kStopIsNot: it is another.
//
// *No plan is lost*: a path that realizes a sequence of the class realizes one of the first kind or
// one of the second (or both: the sides share no sequence, but may share paths).
//
// The path at hand obeys the first side, so no split on sequences raises the cost of both sides.
// What it does is to take away ties: with the order settled, the conflicts left are dearer.
#include "conflicts/sequence_split.h"

#include <bit>

#include "model/assert.h"

namespace grove::detail {

Split sequence_split(AgentIndex agent, const AgentStops& stops, const SequenceClass& work,
                     const Sequence& sequence) {
  const std::size_t number = work.prefix.size();
  const auto at = static_cast<Time>(number);
  GROVE_ASSERT(number < sequence.size(), "a class that is split leaves stops open");
  const Stop stop = sequence.at(number);
  const Place place = stops.place(stop);
  return {{{agent, {place, stop, at, at, ConstraintKind::kStopIs}},
           {agent, {place, stop, at, at, ConstraintKind::kStopIsNot}}}};
}

bool leaves_choice(const AgentStops& stops, const SequenceClass& work) {
  const int left = stops.count() - static_cast<int>(work.prefix.size());
  return left - std::popcount(work.forbidden_next) > 1;
}

}  // namespace grove::detail
