// SPDX-License-Identifier: MIT
// Generated roadmaps, always strongly connected. All throw std::invalid_argument if the numbers
// contradict each other.
#pragma once

#include <cstdint>

#include "model/roadmap.h"

namespace grove::detail {

// Lengths are in metres. Members without a stated range must be positive.
struct PlanarRequest {
  int vertices = 100;
  double width = 50;
  double height = 50;
  int one_way = 0;  // percent of the roads
  double metres_per_step = 1;
  std::uint64_t seed = 0;
};

// Makes vertices v0, v1, ... at random positions at least a step apart, joined by straight roads
// that do not cross. Bridges stay two-way, so there may be fewer one-way roads than requested.
Roadmap planar_roadmap(const PlanarRequest& request);

struct WarehouseRequest {
  int aisles = 20;  // an even number
  int slots = 20;   // per aisle, at least one between two cross aisles
  int cross_aisles = 3;
  int bays = 3;  // between two neighbouring aisles, at either end of the building; may be 0
  double aisle_spacing = 4;
  double slot_spacing = 1;  // between slots, between the lanes of a cross aisle, from bay to lane
  double metres_per_step = 1;
};

// Makes slots a<aisle>s<slot> in one-way aisles of alternating direction. Cross aisles have two
// lanes, one for each direction, which meet the aisles at c<cross aisle>e<aisle> (eastbound) and
// c<cross aisle>w<aisle>. Parking bays p<bay> are beside the outermost lanes, each on a short
// two-way road from a vertex g<bay> of its lane.
Roadmap warehouse_roadmap(const WarehouseRequest& request);

// Returns the steps that a road of this length takes, rounded up.
Time steps_of(double metres, double metres_per_step);

}  // namespace grove::detail
