// SPDX-License-Identifier: MIT
// Sets of constraints as memories keep them: about 6 bytes for each instead of 20.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/detail/planning/constraint.h"

namespace grove::detail {

// Appends `constraints` to `bytes`, each as what it differs in from the one before. Short where
// they are in canonical order (situations.h). Two lists are the same if and only if their bytes
// are. Throws std::bad_alloc.
void pack(std::span<const Constraint> constraints, std::string& bytes);

// What pack() made these bytes of; they must be what it made, and nothing else.
std::vector<Constraint> unpacked_constraints(std::string_view bytes);

}  // namespace grove::detail
