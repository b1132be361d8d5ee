// SPDX-License-Identifier: MIT
// Where places are in the world that robots drive in.
#pragma once

#include "model/map.h"

namespace grove::detail {

// How a grid lies in the world: metres, x to the right and y up, as ROS and VDA 5050 have it.
struct Frame {
  double cell_size = 1;  // metres; > 0
  Point origin;          // the lower left corner of the whole map
};

// The middle of a place. `frame` is about grids; a roadmap says itself where its places are.
Point metres(const Map& map, const Frame& frame, Place place);

}  // namespace grove::detail
