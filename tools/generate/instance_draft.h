// SPDX-License-Identifier: MIT
// Common part of generated instances on grids and on roadmaps: assignment of tasks, motion of
// agents, durations of tasks.
#pragma once

#include <string>
#include <vector>

#include "model/instance.h"
#include "tools/generate/instance_generator.h"
#include "tools/generate/random.h"

namespace grove::detail {

struct DrawnAgent {
  std::string row;  // row of the scenario, for messages; may be ""
  Place start = kNoPlace;
  Place goal = kNoPlace;
};

// An instance under construction. `file`, the source of the agents, is named in messages. All
// members throw InputError.
class InstanceDraft {
 public:
  // Agents a0, a1, ...
  InstanceDraft(std::string file, std::vector<DrawnAgent> agents, const InstanceRequest& request);

  int task_count() const { return static_cast<int>(tasks_.size()); }
  bool has_task_on(Place place) const;
  // Adds the next of the tasks t0, t1, ... and gives it to 1, 2 or 3 agents drawn from `able`.
  void add_task(Place place, std::vector<int> able);

  Instance build(Map map) &&;

 private:
  struct DrawnTask {
    Place place;
    std::vector<int> agents;
  };

  [[noreturn]] void fail(const std::string& place, const std::string& message) const;
  void turn_goals_into_tasks();
  void add_agents(InstanceBuilder& builder) const;
  AgentSpec spec(int agent, Heading heading, Heading goal_heading) const;
  void add_tasks(InstanceBuilder& builder) const;

  std::string file_;
  std::vector<DrawnAgent> agents_;
  InstanceRequest request_;
  Random random_;
  std::vector<DrawnTask> tasks_;
};

}  // namespace grove::detail
