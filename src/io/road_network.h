// SPDX-License-Identifier: MIT
// Road networks in metres and seconds, as in files of other tools, and their conversion to steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/roadmap.h"

namespace grove::detail {

// A road in metres and seconds.
struct Link {
  int from = 0;  // positions in RoadNetwork::vertices
  int to = 0;
  bool one_way = false;
  double metres = 0;              // length; positive and finite, as is `seconds`
  std::optional<double> seconds;  // at the maximum speed; nullopt: not in the file
  std::string place;              // position in the file, such as "line 7, column 3" or "/edges/2"
};

// The roads in a file of another tool. The ids of the vertices are distinct and not empty. The two
// ends of a link can be the same vertex; in_steps() rejects such a link.
struct RoadNetwork {
  std::string file;  // for messages
  std::vector<Vertex> vertices;
  std::vector<Link> links;
};

// The distance that a robot travels per time step, and the duration of a time step. At least one of
// them is set.
struct StepScale {
  std::optional<double> metres_per_step{};
  std::optional<double> seconds_per_step{};
};

// The rounding up of a link's number of steps.
struct Rounding {
  int link = -1;     // position in RoadNetwork::links; -1: no link was rounded
  double exact = 0;  // number of steps before rounding
  Time steps = 0;

  double absolute() const { return steps - exact; }  // error in steps
  double relative() const { return link < 0 ? 0 : absolute() / exact; }
};

// The roads of a network in steps, one for each link, and the links with the largest rounding
// errors.
struct SteppedRoads {
  std::vector<Road> roads;
  Rounding max_absolute;
  Rounding max_relative;
};

// Converts links to roads. The number of steps of a road is the maximum of metres / metres_per_step
// and seconds / seconds_per_step, where a quotient is omitted if `scale` or the link lacks a value
// for it. The result is rounded up and is at least 1. A quotient that differs from an integer only
// by the rounding errors of floating-point arithmetic counts as this integer. Throws InputError,
// with the position of the link, if no quotient remains for a link, if both of its ends are the
// same vertex, or if the roads up to this one have more places than a Roadmap or `rules` allow.
SteppedRoads in_steps(const RoadNetwork& network, const StepScale& scale,
                      const InputRules& rules = {});

// Numbers of pairs of one-way roads in opposite directions between the same two vertices. Such a
// pair represents two lanes, on which agents can pass each other.
struct OppositeRoads {
  int alike = 0;        // pairs with equal numbers of steps
  int unlike = 0;       // other pairs
  int single_step = 0;  // those of `alike` with one step, on which agents cannot pass each other
};
OppositeRoads opposite_roads(const std::vector<Road>& roads);

// Returns the roads with each pair of equal numbers of steps replaced by one two-way road, at the
// position of the pair's first road.
std::vector<Road> with_merged_lanes(const std::vector<Road>& roads);

}  // namespace grove::detail
