// SPDX-License-Identifier: MIT
// Generates strongly connected roadmaps. All generators throw std::invalid_argument if their
// arguments contradict each other.
#pragma once

#include <cstdint>

#include "model/roadmap.h"

namespace grove::detail {

// Lengths are in metres. Except for `seed`, members without a stated range must be positive.
struct PlanarRequest {
  int vertices = 100;
  double width = 50;
  double height = 50;
  int one_way = 0;  // percent of the roads, from 0 to 100
  double metres_per_step = 1;
  std::uint64_t seed = 0;
};

// Returns a roadmap with vertices v0, v1, ... at random positions (in whole centimetres) at least
// `metres_per_step` apart, joined by straight roads that do not cross. Bridges stay two-way, so
// there can be fewer one-way roads than requested. Throws std::invalid_argument if it finds no
// positions for all vertices.
Roadmap planar_roadmap(const PlanarRequest& request);

struct WarehouseRequest {
  int aisles = 20;       // an even number
  int slots = 20;        // per aisle; at least one between each two neighbouring cross aisles
  int cross_aisles = 3;  // including those at the ends; at least 2
  int bays = 3;  // between each two neighbouring aisles, at either end of the building; can be 0
  double aisle_spacing = 4;
  double slot_spacing = 1;  // also between the lanes of a cross aisle, and from a bay to its lane
  double metres_per_step = 1;
};

// Returns a roadmap with slots a<aisle>s<slot> in one-way aisles of alternating direction. Each
// cross aisle has one lane per direction. The lanes meet the aisles at c<cross aisle>e<aisle>
// (eastbound) and c<cross aisle>w<aisle> (westbound). Parking bays p<bay> are beside the outermost
// lanes, each joined by a short two-way road to a vertex g<bay> on the lane.
Roadmap warehouse_roadmap(const WarehouseRequest& request);

// Returns the duration of a road of `metres` metres in time steps, rounded up; at least 1.
Time steps_of(double metres, double metres_per_step);

}  // namespace grove::detail
