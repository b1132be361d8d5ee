// SPDX-License-Identifier: MIT
// Compressed constraint sets, for cache keys and messages: about 6 bytes per constraint instead of
// 20.
#pragma once

#include <span>
#include <string>

#include "planning/constraint.h"

namespace grove::detail {

// Appends `constraints` to `bytes`. Each constraint is encoded as the difference from the previous
// one, which is short in canonical order (subproblem_table.h). Two lists are equal if and only if
// their bytes are equal.
void pack(std::span<const Constraint> constraints, std::string& bytes);

// Result of pack(), which can be compared, stored and sent. No function unpacks it.
struct PackedConstraints {
  PackedConstraints() = default;  // no constraints
  explicit PackedConstraints(std::span<const Constraint> constraints) { pack(constraints, bytes); }

  std::string bytes;
  friend bool operator==(const PackedConstraints&, const PackedConstraints&) = default;
};

}  // namespace grove::detail
