// SPDX-License-Identifier: MIT
// Roadmaps of our own making. From every vertex a way leads to every other. All throw
// std::invalid_argument when the numbers do not fit together.
#pragma once

#include <cstdint>

#include "model/roadmap.h"

namespace grove::detail {

// Lengths are in metres; those that are not given a range must be positive.
struct PlanarRequest {
  int vertices = 100;
  double width = 50;
  double height = 50;
  int one_way = 0;  // percent of the roads
  double metres_per_step = 1;
  std::uint64_t seed = 0;
};

// Vertices v0, v1, ... at random, at least a step apart, joined by straight roads that do not
// cross. Roads that alone join two parts stay two-way, so fewer than asked may be one way.
Roadmap planar_roadmap(const PlanarRequest& request);

struct WarehouseRequest {
  int aisles = 20;  // an even number
  int slots = 20;   // in each aisle, at least one between two cross aisles
  int cross_aisles = 3;
  int bays = 3;  // between two aisles, at either end of the building; may be 0
  double aisle_spacing = 4;
  double slot_spacing = 1;  // of slots, of the two lanes of a cross aisle, and of bays from theirs
  double metres_per_step = 1;
};

// Slots a<aisle>s<slot> in aisles that are one way, to and fro in turn; cross aisles of two lanes,
// one for each direction, which meet the aisles at c<cross aisle>e<aisle>, eastbound, and
// c<cross aisle>w<aisle>; and parking bays p<bay> beside the outermost lanes, each on a short
// two-way road from a vertex of its lane, g<bay>.
Roadmap warehouse_roadmap(const WarehouseRequest& request);

// What a road this long takes, in whole steps.
Time steps_of(double metres, double metres_per_step);

}  // namespace grove::detail
