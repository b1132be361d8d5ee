// SPDX-License-Identifier: MIT
#include "proof/proof_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace grove::detail {
namespace {

std::string until(Time end) {
  return end >= kNever ? "inf" : fmt::to_string(end);
}

}  // namespace

std::string proof_text(const AgentConstraint& demand, const Instance& instance) {
  const Constraint& c = demand.constraint;
  const auto text = [&](std::string_view what, auto... values) {
    std::string line = fmt::format("{} {}", demand.agent, what);
    ((line += fmt::format(" {}", values)), ...);
    return line;
  };
  const auto task = [&] { return instance.agent(demand.agent).stops[c.from]; };
  switch (c.kind) {
    case ConstraintKind::kVertexOrEdge:
      if (c.is_move()) return text("move", c.from, c.cell, std::max(c.begin, 0), until(c.end));
      return text("bar", c.cell, std::max(c.begin, 0), until(c.end));
    case ConstraintKind::kNoRestBy:
      return text("norest", c.cell, c.end);
    case ConstraintKind::kRestBy:
      return text("rest", c.cell, c.end);
    case ConstraintKind::kNoTraversal:
      return text("pass", c.from, c.cell, c.begin, until(c.end));
    case ConstraintKind::kStopIs:
      return text("stop", c.begin, task());
    case ConstraintKind::kStopIsNot:
      return text("nostop", c.begin, task());
  }
  return {};
}

std::string proof_text(const Split& split, const Instance& instance) {
  return fmt::format("split {} | {}", proof_text(split[0], instance),
                     proof_text(split[1], instance));
}

std::string proof_text(const RowMultiplier& charged) {
  const auto& [row, charge] = charged;
  switch (row.kind) {
    case RelaxedRow::Kind::kPlace:
      return fmt::format("place {} {} {}", row.a, row.time, charge);
    case RelaxedRow::Kind::kEdge:
      return fmt::format("edge {} {} {} {}", row.a, row.b, row.time, charge);
    case RelaxedRow::Kind::kFinish:
      return fmt::format("finish {} {} {} {} {}", row.a, row.time, row.b, row.time_b, charge);
  }
  return {};
}

std::string proof_text(Cost cost) {
  return cost >= kInfiniteCost ? "inf" : fmt::to_string(cost);
}

}  // namespace grove::detail
