// SPDX-License-Identifier: MIT
// Roads in metres and seconds, as in files of other tools, and their conversion to steps.
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
  double metres = 0;              // positive and finite, as is `seconds`
  std::optional<double> seconds;  // at the maximum speed; nullopt if not in the file
  std::string place;  // position in the file, for messages: "line 7, column 3", "/edges/2"
};

// The roads in a file of another tool. The ids of the vertices are distinct and not empty. Each
// link leads from one vertex to another.
struct RoadNetwork {
  std::string file;  // for messages
  std::vector<Vertex> vertices;
  std::vector<Link> links;
};

// The distance that a robot travels per step, and the duration of a step. At least one of them is
// set.
struct StepScale {
  std::optional<double> metres_per_step{};
  std::optional<double> seconds_per_step{};
};

// A link whose number of steps was rounded up.
struct Rounding {
  int link = -1;     // position; -1: no link was rounded
  double exact = 0;  // steps before rounding up
  Time steps = 0;

  double absolute() const { return steps - exact; }  // in steps
  double relative() const { return link < 0 ? 0 : absolute() / exact; }
};

// The roads of a network in steps, one for each link, and the largest rounding errors.
struct SteppedRoads {
  std::vector<Road> roads;
  Rounding max_absolute;
  Rounding max_relative;
};

// The number of steps of a road is metres / metres_per_step or seconds / seconds_per_step; if the
// scale has both, the maximum, or only the former if the link has no seconds. It is rounded up, and
// is at least 1. A value that differs from an integer only by rounding errors of the arithmetic
// counts as this integer. Throws InputError, with the position of the link, if only seconds count
// and a link has none, and if the roads have more places than a Roadmap or `rules` allow.
SteppedRoads in_steps(const RoadNetwork& network, const StepScale& scale,
                      const InputRules& rules = {});

// Pairs of one-way roads in opposite directions between two vertices. Such a pair consists of two
// lanes, on which agents can pass each other.
struct OppositeRoads {
  int alike = 0;    // pairs with equal numbers of steps
  int unlike = 0;   // other pairs
  int of_step = 0;  // number of `alike` pairs with one step, on which agents cannot pass each other
};
OppositeRoads opposite_roads(const std::vector<Road>& roads);

// Replaces each pair with equal numbers of steps by one two-way road, which the agents share, at
// the position of the pair's first road.
std::vector<Road> with_merged_lanes(const std::vector<Road>& roads);

}  // namespace grove::detail
