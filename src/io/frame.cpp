// SPDX-License-Identifier: MIT
#include "io/frame.h"

namespace grove::detail {

Point metres(const Map& map, const Frame& frame, Place place) {
  if (const auto* roadmap = std::get_if<Roadmap>(&map)) return roadmap->at(place);
  const Grid& grid = std::get<Grid>(map);
  const Position p = grid.position(place);
  return {frame.origin.x + (p.x + 0.5) * frame.cell_size,
          frame.origin.y + (grid.height() - p.y - 0.5) * frame.cell_size};
}

}  // namespace grove::detail
