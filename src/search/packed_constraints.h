// SPDX-License-Identifier: MIT
// Sets of constraints as memories keep them: about 6 bytes for each instead of 20.
#pragma once

#include <span>
#include <string>

#include "planning/constraint.h"

namespace grove::detail {

// Appends `constraints` to `bytes`, each as what it differs in from the one before: short where
// they are in canonical order (situations.h). Two lists are the same if and only if their bytes
// are.
void pack(std::span<const Constraint> constraints, std::string& bytes);

// What pack() makes of a list: to be compared, kept and told, never to be taken apart.
struct PackedConstraints {
  PackedConstraints() = default;  // none
  explicit PackedConstraints(std::span<const Constraint> constraints) { pack(constraints, bytes); }

  std::string bytes;
  friend bool operator==(const PackedConstraints&, const PackedConstraints&) = default;
};

}  // namespace grove::detail
