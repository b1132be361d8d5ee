// SPDX-License-Identifier: MIT
// Names of the components of the engine.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace grove::detail {

// The components, in the order of their registration. Messages contain the numeric values.
enum class ComponentId : std::uint8_t {
#define GROVE_COMPONENT(id, name, make) id,
#include "engine/components.def"
#undef GROVE_COMPONENT
};

// By ComponentId: name in logs.
inline constexpr std::array kComponentNames = {
#define GROVE_COMPONENT(id, name, make) std::string_view(name),
#include "engine/components.def"
#undef GROVE_COMPONENT
};

inline constexpr auto kLastComponent = static_cast<ComponentId>(kComponentNames.size() - 1);

constexpr std::string_view name_of(ComponentId id) {
  return kComponentNames[static_cast<std::size_t>(id)];
}

}  // namespace grove::detail
