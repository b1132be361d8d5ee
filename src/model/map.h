// SPDX-License-Identifier: MIT
// The map of an instance, which is a grid or a roadmap.
#pragma once

#include <variant>

#include "model/grid.h"
#include "model/roadmap.h"

namespace grove::detail {

using Map = std::variant<Grid, Roadmap>;

inline const World& ground(const Map& map) {
  return std::visit([](const auto& m) -> const World& { return m; }, map);
}

}  // namespace grove::detail
