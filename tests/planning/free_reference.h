// SPDX-License-Identifier: MIT
// Reference for single-agent search that chooses the order of the stops: by definition, time step
// by time step, and by enumeration of orders.
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

// An instance with only this agent.
Instance instance_of(const FreeProblem& problem);

// A problem and the library's objects for it. Not movable.
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

// The least cost of a path that realizes a sequence of the class. Returns nullopt if there is no
// path. An agent on a stop may or may not count it. It rests on its destination, or, without one,
// on the stop counted last.
std::optional<Time> free_reference_cost(const FreeProblem& problem);

// Describes why `path` does not realize this sequence of all stops; empty if it does.
std::string path_error(const FreeProblem& problem, const Sequence& sequence, const Path& path);

// All members of a class of n stops.
std::vector<Sequence> members_of(const SequenceClass& work, int n);

}  // namespace grove::detail::testing
