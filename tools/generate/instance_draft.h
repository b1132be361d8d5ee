// SPDX-License-Identifier: MIT
// Parts of generated instances that grids and roadmaps have in common: assignment of tasks to
// agents, headings of agents, durations of tasks, choices.
#pragma once

#include <string>
#include <vector>

#include "model/instance.h"
#include "tools/generate/instance_generator.h"
#include "tools/generate/random.h"

namespace grove::detail {

struct DrawnAgent {
  std::string row;  // row of the scenario, for error messages; can be ""
  Place start = kNoPlace;
  Place goal = kNoPlace;
};

// An instance under construction. Error messages name `file`, from which the agents are drawn.
class InstanceDraft {
 public:
  // The agents get the ids a0, a1, ...
  InstanceDraft(std::string file, std::vector<DrawnAgent> agents, const InstanceRequest& request);

  int task_count() const { return static_cast<int>(tasks_.size()); }
  bool has_task_on(Place place) const;
  // Adds a task on `place`; tasks get the ids t0, t1, .... Assigns it to 1, 2 or 3 distinct agents
  // drawn from `able`, which must not be empty, unless build() gives it a need.
  void add_task(Place place, std::vector<int> able);

  // Throws InputError if the instance is invalid.
  Instance build(Map map) &&;

 private:
  struct DrawnTask {
    Place place;
    std::vector<int> agents;
    std::vector<int> able = {};  // candidates, if some tasks get a need
    int need = 0;                // 0: all of `agents`
  };

  [[noreturn]] void fail(const std::string& place, const std::string& message) const;
  void give_needs();
  void turn_goals_into_tasks();
  void add_agents(InstanceBuilder& builder) const;
  AgentSpec spec(int agent, const std::vector<int>& goals, Heading heading,
                 Heading goal_heading) const;
  void add_tasks(InstanceBuilder& builder) const;

  std::string file_;
  std::vector<DrawnAgent> agents_;
  InstanceRequest request_;
  Random random_;
  std::vector<DrawnTask> tasks_;
};

}  // namespace grove::detail
