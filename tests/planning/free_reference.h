// SPDX-License-Identifier: MIT
// What the free low level must find, by definition: time step by time step, and order by order.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/distance_field.h"
#include "model/instance.h"
#include "model/plan.h"
#include "planning/constraint.h"
#include "planning/sequence_stages.h"
#include "sequencing/rtsp.h"

namespace grove::detail::testing {

struct FreeProblem {
  const Grid* grid = nullptr;
  Cell start = kNoCell;
  std::vector<Cell> stops;
  std::optional<Cell> destination;
  SequenceClass work;
  std::vector<Constraint> constraints;
};

// With this one agent.
Instance instance_of(const FreeProblem& problem);

// What the library makes of it; not to be moved.
struct FreeAgent {
  explicit FreeAgent(const FreeProblem& given)
      : problem(given),
        instance(instance_of(given)),
        distances(instance),
        stops(instance, distances, 0),
        goals(stops, given.work) {}
  FreeAgent(const FreeAgent&) = delete;

  FreeProblem problem;
  Instance instance;
  DistanceFields distances;
  AgentStops stops;
  SequenceStages goals;
};

// The cost of a cheapest path that realizes a sequence of the class, none if there is no path. An
// agent on a stop may or may not count it; it rests on its destination, or without one on the stop
// counted last.
std::optional<Time> free_reference_cost(const FreeProblem& problem);

// What is wrong with `path` as one that realizes this sequence of all stops; empty if nothing.
std::string path_error(const FreeProblem& problem, const Sequence& sequence, const Path& path);

// All members of a class of n stops.
std::vector<Sequence> members_of(const SequenceClass& work, int n);

}  // namespace grove::detail::testing
