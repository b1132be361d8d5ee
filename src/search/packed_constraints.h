// SPDX-License-Identifier: MIT
// Compressed constraint sets, for cache keys and messages: about 6 bytes per constraint instead of
// 20.
#pragma once

#include <span>
#include <string>

#include "planning/constraint.h"

namespace grove::detail {

// Appends `constraints` to `bytes`. Each constraint is encoded as the difference from the one
// before, which is short in canonical order (subproblem_table.h). Two lists are equal if and only
// if their bytes are equal.
void pack(std::span<const Constraint> constraints, std::string& bytes);

// Result of pack(), to be compared, stored and sent. It cannot be unpacked here.
struct PackedConstraints {
  PackedConstraints() = default;  // none
  explicit PackedConstraints(std::span<const Constraint> constraints) { pack(constraints, bytes); }

  std::string bytes;
  friend bool operator==(const PackedConstraints&, const PackedConstraints&) = default;
};

}  // namespace grove::detail
