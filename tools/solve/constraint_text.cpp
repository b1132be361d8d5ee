// SPDX-License-Identifier: MIT
#include "tools/solve/constraint_text.h"

#include <fmt/format.h>

#include <variant>

namespace grove::detail {
namespace {

std::string name_of(const Instance& instance, Place place) {
  return std::visit([&](const auto& map) { return map.name(place); }, instance.map());
}

std::string times(const Constraint& c) {
  if (c.end == kNever) return fmt::format("from {} on", c.begin);
  return c.begin == c.end ? fmt::format("at {}", c.begin)
                          : fmt::format("from {} to {}", c.begin, c.end);
}

}  // namespace

std::string text_of(const Conflict& conflict, const Instance& instance) {
  const std::string& first = instance.agent(conflict.first).id;
  const std::string& second = instance.agent(conflict.second).id;
  const std::string place = name_of(instance, conflict.cell);
  if (conflict.is_following()) {
    const bool first_follows = conflict.follower == conflict.first;
    return fmt::format("{} follows {} onto {} at {}", first_follows ? first : second,
                       first_follows ? second : first, place, conflict.time);
  }
  if (!conflict.is_swap())
    return fmt::format("{} and {} on {} at {}", first, second, place, conflict.time);
  return fmt::format("{} and {} swap {} and {} at {}", first, second,
                     name_of(instance, conflict.from), place, conflict.time);
}

std::string text_of(const AgentConstraint& constraint, const Instance& instance) {
  if (constraint.agent < 0) return "";
  const Constraint& c = constraint.constraint;
  const std::string& agent = instance.agent(constraint.agent).id;
  const std::string place = name_of(instance, c.cell);
  switch (c.kind) {
    case ConstraintKind::kVertexOrEdge:
      return c.is_move() ? fmt::format("{} not from {} to {}, arriving {}", agent,
                                       name_of(instance, c.from), place, times(c))
                         : fmt::format("{} not on {} {}", agent, place, times(c));
    case ConstraintKind::kNoRestBy:
      return fmt::format("{} not at rest on {} by {}", agent, place, c.end);
    case ConstraintKind::kRestBy:
      return fmt::format("{} at rest on {} by {}, no other agent there from then on", agent, place,
                         c.end);
    case ConstraintKind::kNoTraversal:
      return fmt::format("{} not through the passage by {} to {}, arriving {}", agent,
                         name_of(instance, c.from), place, times(c));
    case ConstraintKind::kStopIs:
      return fmt::format("{}'s stop {} is on {}", agent, c.begin + 1, place);
    case ConstraintKind::kStopIsNot:
      return fmt::format("{}'s stop {} is not the one on {}", agent, c.begin + 1, place);
  }
  return "";
}

}  // namespace grove::detail
