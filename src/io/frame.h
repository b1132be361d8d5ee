// SPDX-License-Identifier: MIT
// Converts places to coordinates in the world frame of the robots.
#pragma once

#include <variant>

#include "model/map.h"

namespace grove::detail {

// Position of a grid in the world frame, which has coordinates in metres, x to the right and y up,
// as in ROS and VDA 5050.
struct Frame {
  double cell_size = 1;  // metres; > 0
  Point origin;          // lower left corner of the map
};

// The centre of `place` in the world frame, in metres. `frame` is used for grids only; a roadmap
// has coordinates of its own.
inline Point metres(const Map& map, const Frame& frame, Place place) {
  if (const auto* roadmap = std::get_if<Roadmap>(&map)) return roadmap->at(place);
  const Grid& grid = std::get<Grid>(map);
  const Position p = grid.position(place);
  return {frame.origin.x + (p.x + 0.5) * frame.cell_size,
          frame.origin.y + (grid.height() - p.y - 0.5) * frame.cell_size};
}

}  // namespace grove::detail
