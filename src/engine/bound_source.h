// SPDX-License-Identifier: MIT
// Who proves a bound beside the tree.
#pragma once

#include <cstdint>
#include <string_view>

namespace grove::detail {

// The numbers are those of messages.
enum class BoundSource : std::uint8_t {
  kJointSearch,  // A* over joint states
  kLagrangian,   // prices and multipliers
};
inline constexpr BoundSource kLastProvenBy = BoundSource::kLagrangian;

// As logs have it.
constexpr std::string_view name_of(BoundSource by) {
  return by == BoundSource::kJointSearch ? "joint" : "lagrangian";
}

}  // namespace grove::detail
