// SPDX-License-Identifier: MIT
// Occupancy grids of ROS (map_server): an image of free space, with scale and position.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/frame.h"
#include "io/input_rules.h"
#include "model/grid.h"

namespace grove::detail {

// Free space by pixel, in the file's mode "trinary"; unknown space is not free.
class OccupancyMap {
 public:
  // Reads map.yaml and its image, PGM or PNG. Throws InputError, also for a yaw other than 0 and
  // for modes and thresholds other than those of trinary maps.
  explicit OccupancyMap(const std::filesystem::path& yaml, const InputRules& rules = {});
  // From memory: rows from the top, `resolution` metres per pixel.
  OccupancyMap(int width, int height, std::vector<bool> free, double resolution, Point origin);

  double resolution() const { return resolution_; }
  Point origin() const { return origin_; }  // lower left corner, metres
  double width() const { return width_ * resolution_; }
  double height() const { return height_ * resolution_; }

  // Whether all pixels within `radius` of `at` are free and inside the image. Metres from the lower
  // left corner.
  bool is_clear(Point at, double radius) const;

 private:
  bool is_free(int x, int y) const;

  int width_ = 0;  // pixels
  int height_ = 0;
  std::vector<bool> free_;  // row by row from the top
  double resolution_ = 0;
  Point origin_;
};

// A map of cells. The lower left corner of its lowest row is that of the image.
struct CellMap {
  Grid grid;
  int too_near = 0;  // blocked cells whose middle is free but too near to a wall
  int narrow = 0;    // cells blocked because no robot can move from them to a neighbour
};

// Returns a map of cells of `cell_size` metres. A cell is passable if a robot of radius
// `robot_radius` metres fits at its middle. Between two passable neighbours the robot can move
// straight: if it cannot, the one with fewer connections is blocked. Throws std::invalid_argument
// if no cell fits into the image.
CellMap cells_of(const OccupancyMap& map, double cell_size, double robot_radius);

}  // namespace grove::detail
