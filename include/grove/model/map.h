// SPDX-License-Identifier: MIT
// What agents move on.
#pragma once

#include <variant>

#include "grove/model/grid.h"
#include "grove/model/roadmap.h"

namespace grove {

using Map = std::variant<Grid, Roadmap>;

inline const World& ground(const Map& map) {
  return std::visit([](const auto& m) -> const World& { return m; }, map);
}

}  // namespace grove
