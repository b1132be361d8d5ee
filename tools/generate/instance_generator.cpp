// SPDX-License-Identifier: MIT
#include "tools/generate/instance_generator.h"

#include <fmt/format.h>

#include <algorithm>

#include "grove/io/input_error.h"
#include "tools/generate/components.h"
#include "tools/generate/random.h"

namespace grove {
namespace {

constexpr int kRowsReservedForAgents = 20;
constexpr int kMostAgentsPerTask = 3;

struct DrawnTask {
  Position cell;
  std::vector<int> agents;  // row numbers of its agents, from 0
};

class Generator {
 public:
  Generator(const Grid& grid, const Scenario& scenario, const InstanceRequest& request)
      : grid_(grid),
        scenario_(scenario),
        request_(request),
        component_(components(grid)),
        random_(random_for(RandomUse::kTasks, request.seed)) {}

  Instance run() {
    require_rows(request_.agents);
    draw_tasks();
    if (request_.mg) turn_goals_into_tasks();
    return build();
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    throw InputError(scenario_.name, place, message);
  }

  void require_rows(int count) const {
    if (scenario_.rows.size() < static_cast<std::size_t>(count))
      fail("", fmt::format("has {} rows; {} agents need as many", scenario_.rows.size(), count));
  }

  void draw_tasks() {
    auto row = static_cast<std::size_t>(first_task_row(request_.agents));
    while (static_cast<int>(tasks_.size()) < request_.tasks) {
      if (row >= scenario_.rows.size()) fail_for_lack_of_rows();
      const Position cell = scenario_.rows[row++].start;
      std::vector<int> agents = agents_that_reach(cell);
      if (task_on(cell) || agents.empty()) continue;
      random_.shuffle(agents);
      const std::size_t count = 1 + random_.below(kMostAgentsPerTask);
      agents.resize(std::min(agents.size(), count));
      std::ranges::sort(agents);
      tasks_.push_back({cell, std::move(agents)});
    }
  }

  [[noreturn]] void fail_for_lack_of_rows() const {
    fail("", fmt::format("has {} rows, enough for {} of {} tasks; they are taken from row {} on",
                         scenario_.rows.size(), tasks_.size(), request_.tasks,
                         first_task_row(request_.agents) + 1));
  }

  std::vector<int> agents_that_reach(Position cell) const {
    std::vector<int> agents;
    if (!grid_.contains(cell)) return agents;
    for (int i = 0; i < request_.agents; ++i)
      if (component_at(scenario_.rows[i].start) == component_at(cell) && component_at(cell) >= 0)
        agents.push_back(i);
    return agents;
  }

  int component_at(Position p) const { return grid_.contains(p) ? component_[grid_.cell(p)] : -1; }

  DrawnTask* task_on(Position cell) {
    const auto it = std::ranges::find(tasks_, cell, &DrawnTask::cell);
    return it == tasks_.end() ? nullptr : &*it;
  }

  void turn_goals_into_tasks() {
    for (int i = 0; i < request_.agents; ++i) {
      const Position goal = scenario_.rows[i].goal;
      DrawnTask* task = task_on(goal);
      if (!task) task = &tasks_.emplace_back(DrawnTask{goal, {}});
      if (std::ranges::find(task->agents, i) == task->agents.end()) task->agents.push_back(i);
    }
  }

  static std::string agent_id(int i) { return fmt::format("a{}", i); }

  Instance build() const {
    InstanceBuilder builder(grid_);
    for (int i = 0; i < request_.agents; ++i) add_agent(builder, i);
    for (std::size_t k = 0; k < tasks_.size(); ++k) add_task(builder, k);
    return std::move(builder).build();
  }

  void add_agent(InstanceBuilder& builder, int i) const {
    const ScenarioRow& row = scenario_.rows[i];
    try {
      if (!grid_.contains(row.goal) || !grid_.passable(grid_.cell(row.goal)))
        throw InstanceError("goal", fmt::format("cell [{}, {}] is not a passable cell of the map",
                                                row.goal.x, row.goal.y));
      const auto goal = request_.mg ? std::nullopt : std::optional<Position>(row.goal);
      builder.add_agent(agent_id(i), row.start, goal);
    } catch (const InstanceError& error) {
      fail(fmt::format("line {}, {}", row.line, error.field()), error.what());
    }
  }

  void add_task(InstanceBuilder& builder, std::size_t k) const {
    std::vector<std::string> ids;
    for (int agent : tasks_[k].agents) ids.push_back(agent_id(agent));
    try {
      builder.add_task(fmt::format("t{}", k), tasks_[k].cell, ids);
    } catch (const InstanceError& error) {
      fail("", fmt::format("{} tasks for {} agents do not fit: {}", request_.tasks, request_.agents,
                           error.what()));
    }
  }

  const Grid& grid_;
  const Scenario& scenario_;
  const InstanceRequest& request_;
  std::vector<int> component_;
  Random random_;
  std::vector<DrawnTask> tasks_;
};

}  // namespace

int first_task_row(int agents) {
  return std::max(agents, kRowsReservedForAgents);
}

int rows_needed(const InstanceRequest& request) {
  return request.tasks == 0 ? request.agents : first_task_row(request.agents) + request.tasks;
}

Instance generate_instance(const Grid& grid, const Scenario& scenario,
                           const InstanceRequest& request) {
  return Generator(grid, scenario, request).run();
}

}  // namespace grove
