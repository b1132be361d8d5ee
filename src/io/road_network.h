// SPDX-License-Identifier: MIT
// Roads as other tools describe them, in metres and seconds, and what they are in steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/roadmap.h"

namespace grove::detail {

// A road that was measured, not counted.
struct Link {
  int from = 0;  // positions in RoadNetwork::vertices
  int to = 0;
  bool one_way = false;
  double metres = 0;              // positive and finite, as are the seconds
  std::optional<double> seconds;  // at the highest speed allowed, where the file tells
  std::string place;              // in the file, for messages: "line 7, column 3", "/edges/2"
};

// What a file of another tool says about roads. The ids of its vertices are distinct and not empty,
// and links lead from vertex to vertex.
struct RoadNetwork {
  std::string file;  // for messages
  std::vector<Vertex> vertices;
  std::vector<Link> links;
};

// How far a robot goes in a step, and how long a step is; one of the two at least.
struct StepScale {
  std::optional<double> metres_per_step{};
  std::optional<double> seconds_per_step{};
};

// A link whose steps are more than it takes.
struct Rounding {
  int link = -1;     // by position; -1: no link was rounded
  double exact = 0;  // steps, before they were rounded up
  Time steps = 0;

  double absolute() const { return steps - exact; }  // in steps
  double relative() const { return link < 0 ? 0 : absolute() / exact; }
};

// The roads of a network in steps, one for each link, and how far they are from it.
struct SteppedRoads {
  std::vector<Road> roads;
  Rounding most_absolute;
  Rounding most_relative;
};

// A road takes metres / metres_per_step, or seconds / seconds_per_step; where the scale has both,
// the larger of them, and only the former if its seconds are not known. That is rounded up, to 1 at
// least; what is a whole number but for the last digits of the arithmetic is taken for it. Throws
// InputError, with the place of the link, for one without seconds where only they count, and when
// the roads have more places than a Roadmap may or `rules` allow.
SteppedRoads in_steps(const RoadNetwork& network, const StepScale& scale,
                      const InputRules& rules = {});

// Pairs of one-way roads that lead to and fro between two vertices: each is two lanes, on which
// agents pass one another.
struct OppositeRoads {
  int alike = 0;    // pairs of as many steps
  int unlike = 0;   // other pairs
  int of_step = 0;  // of the pairs alike those of one step, on which agents cannot pass
};
OppositeRoads opposite_roads(const std::vector<Road>& roads);

// Each pair alike becomes one two-way road, which agents share, in place of its first.
std::vector<Road> with_merged_lanes(const std::vector<Road>& roads);

}  // namespace grove::detail
