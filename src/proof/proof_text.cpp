// SPDX-License-Identifier: MIT
#include "proof/proof_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace grove::detail {

std::string proof_text_until(Time end) {
  return end >= kNever ? "inf" : fmt::to_string(end);
}

std::string proof_text(const AgentConstraint& constraint, const Instance& instance) {
  const Constraint& c = constraint.constraint;
  const auto text = [&](std::string_view what, auto... values) {
    std::string line = fmt::format("{} {}", constraint.agent, what);
    ((line += fmt::format(" {}", values)), ...);
    return line;
  };
  const auto task = [&] { return instance.agent(constraint.agent).stops[c.from]; };
  switch (c.kind) {
    case ConstraintKind::kVertexOrEdge:
      if (c.is_move())
        return text("move", c.from, c.cell, std::max(c.begin, 0), proof_text_until(c.end));
      return text("bar", c.cell, std::max(c.begin, 0), proof_text_until(c.end));
    case ConstraintKind::kNoRestBy:
      return text("norest", c.cell, c.end);
    case ConstraintKind::kRestBy:
      return text("rest", c.cell, proof_text_until(c.end));
    case ConstraintKind::kNoTraversal:
      return text("pass", c.from, c.cell, c.begin, proof_text_until(c.end));
    case ConstraintKind::kStopIs:
      return text("stop", c.begin, task());
    case ConstraintKind::kStopIsNot:
      return text("nostop", c.begin, task());
  }
  return {};
}

}  // namespace grove::detail
