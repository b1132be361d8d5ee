// SPDX-License-Identifier: MIT
// The joint routes of an instance with choices (sequencing/joint_routes.h).
#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "model/distance_field.h"
#include "model/instance.h"
#include "planning/goal_sequence.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/joint_routes.h"

namespace grove::detail {

// Throws InstanceError if an agent with a choice needs time to turn, starts while it executes an
// optional task, or must or may visit more than kMaxTasksPerAgent tasks. `reason` as for
// require_no_choices().
void require_joint_routes(const Instance& instance, std::string_view reason,
                          std::string_view remedy);

// The joint routes of an instance. Without conflicts between agents, each plan costs at least as
// much as one of them (head of the .cpp). Immutable after construction: any thread may read it.
class InstanceRoutes {
 public:
  // Both must outlive this object. `distances` must be complete. Precondition:
  // require_joint_routes().
  InstanceRoutes(const Instance& instance, const DistanceFields& distances);

  const JointRouteProblem& problem() const { return problem_; }
  // The tasks of the route, in the order of the visits.
  std::vector<TaskIndex> visits(AgentIndex agent, const Sequence& stops) const;
  // The goals of the agent on a route.
  GoalSequence goals(AgentIndex agent, const AgentRoute& route) const;

 private:
  using FieldKey = std::tuple<Place, int, std::optional<Heading>>;

  void add_agent(AgentIndex agent);
  CostMatrix::Matrix legs(AgentIndex agent) const;
  void add_ends(AgentIndex agent);
  void add_end(AgentIndex agent, RouteEnd end, std::optional<PlaceOfRest> rest);
  StopSet stops_on(AgentIndex agent, Place place) const;
  PlaceOfRest rest_on(AgentIndex agent, Place place);
  int resource_of(Place place);

  const Instance& instance_;
  const DistanceFields& distances_;
  JointRouteProblem problem_;
  std::vector<std::vector<TaskIndex>> stops_;  // by agent and stop
  // By agent and end; nullopt: the agent rests on the last stop.
  std::vector<std::vector<std::optional<PlaceOfRest>>> rests_;
  std::vector<int> shared_tasks_;  // by TaskIndex: number in JointRouteProblem::needs, or -1
  std::map<Place, int> resources_;
  std::map<FieldKey, DistanceField> fields_;
};

}  // namespace grove::detail
