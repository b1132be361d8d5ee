// SPDX-License-Identifier: MIT
// Splits a sequence class at a node of the constraint tree (Lawler 1972; the paper's K-best
// sequences use the same partition, but not at nodes and not in response to a conflict).
//
//   kStopIs:    the next stop counted is the one to which the agent goes now;
//   kStopIsNot: it is another one.
//
// *Claim: no plan is lost.* *Proof.* A path that realizes a sequence of the class realizes one of
// the first branch or one of the second. (Or of both: the branches share no sequence, but may share
// paths.)
//
// The current path satisfies the first branch, so no split on sequences raises the cost of both
// branches. Its benefit is to remove ties: with the order fixed, the remaining conflicts cost more.
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
