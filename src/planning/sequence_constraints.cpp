// SPDX-License-Identifier: MIT
#include "planning/sequence_constraints.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <stdexcept>

namespace grove::detail {
namespace {

Stop stop_of(const Constraint& c, const AgentStops& stops, const SequenceClass& work) {
  const int stop = c.from;
  const bool is_left = stop >= 0 && stop < stops.count() && stops.place(stop) == c.cell &&
                       std::ranges::count(work.prefix, static_cast<Stop>(stop)) == 0;
  if (!is_left)
    throw std::invalid_argument("a constraint on a sequence must name a stop that is left");
  return static_cast<Stop>(stop);
}

void append(SequenceClass& work, Stop stop) {
  if ((work.forbidden_next >> stop & 1) != 0)
    throw std::invalid_argument("a constraint on a sequence must name a stop not ruled out");
  work.prefix.push_back(stop);
  work.forbidden_next = 0;
}

// Applies the constraints on the next stop.
void fix_next(SequenceClass& work, const AgentStops& stops,
              std::span<const Constraint> constraints) {
  const auto number = static_cast<Time>(work.prefix.size());
  std::optional<Stop> next;
  for (const Constraint& c : constraints) {
    if (!is_about_sequence(c) || c.begin != number) continue;
    const Stop stop = stop_of(c, stops, work);
    if (c.kind == ConstraintKind::kStopIsNot)
      work.forbidden_next |= StopSet{1} << stop;
    else
      next = stop;
  }
  if (next) append(work, *next);
}

// If only one stop may be next, appends it.
void fix_forced(SequenceClass& work, const AgentStops& stops) {
  StopSet allowed = stops.all() & ~work.forbidden_next;
  for (const Stop stop : work.prefix) allowed &= ~(StopSet{1} << stop);
  if (std::has_single_bit(allowed)) append(work, static_cast<Stop>(std::countr_zero(allowed)));
}

}  // namespace

SequenceClass narrowed(SequenceClass work, const AgentStops& stops,
                       std::span<const Constraint> constraints) {
  for (std::size_t memory_returned = work.prefix.size();; memory_returned = work.prefix.size()) {
    fix_next(work, stops, constraints);
    if (work.prefix.size() == memory_returned) fix_forced(work, stops);
    if (work.prefix.size() == memory_returned) break;
  }
  const auto beyond = [&](const Constraint& c) {
    return is_about_sequence(c) && c.begin > static_cast<Time>(work.prefix.size());
  };
  if (std::ranges::any_of(constraints, beyond))
    throw std::invalid_argument("a constraint on a sequence must follow a settled stop");
  return work;
}

}  // namespace grove::detail
