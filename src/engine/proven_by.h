// SPDX-License-Identifier: MIT
// Who proves a bound beside the tree.
#pragma once

#include <cstdint>
#include <string_view>

namespace grove::detail {

// The numbers are those of messages.
enum class ProvenBy : std::uint8_t {
  kJointSearch,  // A* over joint states
  kLagrangian,   // prices and multipliers
};
inline constexpr ProvenBy kLastProvenBy = ProvenBy::kLagrangian;

// As logs have it.
constexpr std::string_view name_of(ProvenBy by) {
  return by == ProvenBy::kJointSearch ? "joint" : "lagrangian";
}

}  // namespace grove::detail
