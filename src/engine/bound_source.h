// SPDX-License-Identifier: MIT
// Sources of lower bounds outside the tree search.
#pragma once

#include <cstdint>
#include <string_view>

namespace grove::detail {

// The values are used in messages.
enum class BoundSource : std::uint8_t {
  kJointSearch,  // A* over joint states
  kLagrangian,   // Lagrangian relaxation
};
inline constexpr BoundSource kLastProvenBy = BoundSource::kLagrangian;

// Name in logs.
constexpr std::string_view name_of(BoundSource by) {
  return by == BoundSource::kJointSearch ? "joint" : "lagrangian";
}

}  // namespace grove::detail
