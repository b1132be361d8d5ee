// SPDX-License-Identifier: MIT
// Occupancy grids of the ROS map_server: an image of free space, with scale and position.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/frame.h"
#include "io/input_rules.h"
#include "model/grid.h"

namespace grove::detail {

// Free and blocked pixels of an occupancy grid. A pixel is free if its occupancy is below
// free_thresh; all other pixels, also unknown space, are blocked.
class OccupancyMap {
 public:
  // Reads map.yaml and its image (PGM or PNG). Throws InputError for bad files, for a yaw other
  // than 0, and for modes other than "trinary" and "scale".
  explicit OccupancyMap(const std::filesystem::path& yaml, const InputRules& rules = {});
  // Makes a map from memory. `free`: by pixel, row by row from the top. `resolution`: metres per
  // pixel. `origin`: lower left corner, metres.
  OccupancyMap(int width, int height, std::vector<bool> free, double resolution, Point origin);

  double resolution() const { return resolution_; }  // metres per pixel
  Point origin() const { return origin_; }           // lower left corner, metres
  double width() const { return width_ * resolution_; }
  double height() const { return height_ * resolution_; }

  // Returns whether a disc is inside the image and all its pixels are free. `at`: its centre,
  // metres from the lower left corner of the image. `radius`: metres.
  bool is_clear(Point at, double radius) const;

 private:
  bool is_free(int x, int y) const;

  int width_ = 0;  // pixels
  int height_ = 0;
  std::vector<bool> free_;  // row by row from the top
  double resolution_ = 0;
  Point origin_;
};

// A grid map made from an occupancy grid. Both have the same lower left corner.
struct CellMap {
  Grid grid;
  int too_near = 0;  // cells blocked because their centre is free but too near to a blocked pixel
  int narrow = 0;    // cells blocked because the robot cannot move straight to a passable neighbour
};

// Returns a grid map with cells of `cell_size` metres. A cell is passable only if a robot of radius
// `robot_radius` metres fits at its centre. If the robot cannot move straight between two passable
// neighbours, the one with fewer connections is blocked; on a tie, the right or lower one. Throws
// std::invalid_argument if no cell fits into the image.
CellMap cells_of(const OccupancyMap& map, double cell_size, double robot_radius);

}  // namespace grove::detail
