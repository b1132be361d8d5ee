// SPDX-License-Identifier: MIT
// Maps of ROS (map_server): an image of what is free and what is not, and where it lies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/frame.h"
#include "io/input_rules.h"
#include "model/grid.h"

namespace grove::detail {

// Free or not, by pixel, as the file's mode "trinary" says: what is unknown is not free.
class OccupancyMap {
 public:
  // Reads map.yaml and the image it names, PGM or PNG. Throws InputError, also for a yaw, and for
  // modes and thresholds that are not those of trinary maps.
  explicit OccupancyMap(const std::filesystem::path& yaml, const InputRules& rules = {});
  // The same in memory: rows from the top, `resolution` metres a pixel.
  OccupancyMap(int width, int height, std::vector<bool> free, double resolution, Point origin);

  double resolution() const { return resolution_; }
  Point origin() const { return origin_; }  // lower left corner, metres
  double width() const { return width_ * resolution_; }
  double height() const { return height_ * resolution_; }

  // Is there nothing but free space, inside the image, within `radius` of that point? Metres from
  // the lower left corner.
  bool is_clear(Point at, double radius) const;

 private:
  bool is_free(int x, int y) const;

  int width_ = 0;  // pixels
  int height_ = 0;
  std::vector<bool> free_;  // row by row from the top
  double resolution_ = 0;
  Point origin_;
};

// A map of cells, the lower left corner of the lowest row's first one at the image's.
struct CellMap {
  Grid grid;
  int too_near = 0;  // cells whose middle is free but too near to a wall
  int narrow = 0;    // cells that are blocked for no robot gets from them to a neighbour
};

// Cells of that size, metres, whose middle a robot of that radius can be on. Between two neighbours
// that are not blocked it can go straight: of two where it cannot one is blocked, that with fewer
// ways. Throws std::invalid_argument if no cell fits into the image.
CellMap cells_of(const OccupancyMap& map, double cell_size, double robot_radius);

}  // namespace grove::detail
