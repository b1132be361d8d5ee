// SPDX-License-Identifier: MIT
// Reference for single-agent search that chooses the order of the stops. Implements the definition,
// one time step after another, or enumerates orders.
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

// Returns an instance with only this agent.
Instance instance_of(const FreeProblem& problem);

// A problem with the corresponding objects of the library. Not movable.
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

// Returns the least cost of a path that realizes a sequence of the class, or nullopt if there is no
// such path. An agent on a stop may or may not count it as visited. It rests on its destination or,
// without one, on the stop that it counted last.
std::optional<Time> free_reference_cost(const FreeProblem& problem);

// Explains why `path` does not realize this sequence of all stops, or "" if it does.
std::string path_error(const FreeProblem& problem, const Sequence& sequence, const Path& path);

// Returns all sequences of n stops in the class.
std::vector<Sequence> members_of(const SequenceClass& work, int n);

}  // namespace grove::detail::testing
