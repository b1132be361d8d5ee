// SPDX-License-Identifier: MIT
#include "tools/generate/instance_generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/input_error.h"
#include "tools/generate/components.h"
#include "tools/generate/instance_draft.h"

namespace grove::detail {
namespace {

constexpr int kRowsReservedForAgents = 20;

class Generator {
 public:
  Generator(const Grid& grid, const Scenario& scenario, const InstanceRequest& request)
      : grid_(grid),
        scenario_(scenario),
        request_(request),
        component_(components(grid)),
        draft_(scenario.name, agents(), request) {}

  Instance run() {
    draw_tasks();
    return std::move(draft_).build(grid_);
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    throw InputError(scenario_.name, place, message);
  }

  std::vector<DrawnAgent> agents() const {
    if (scenario_.rows.size() < static_cast<std::size_t>(request_.agents))
      fail("", fmt::format("has {} rows; expected at least {}, one for each agent",
                           scenario_.rows.size(), request_.agents));
    std::vector<DrawnAgent> agents;
    for (int i = 0; i < request_.agents; ++i) {
      const ScenarioRow& row = scenario_.rows[i];
      agents.push_back({fmt::format("line {}", row.line), passable_cell(row, "start", row.start),
                        passable_cell(row, "goal", row.goal)});
    }
    return agents;
  }

  Cell passable_cell(const ScenarioRow& row, const std::string& field, Position p) const {
    if (!grid_.contains(p) || !grid_.passable(grid_.cell(p)))
      fail(fmt::format("line {}, {}", row.line, field),
           fmt::format("cell [{}, {}] is not a passable cell of the map", p.x, p.y));
    return grid_.cell(p);
  }

  void draw_tasks() {
    auto row = static_cast<std::size_t>(first_task_row(request_.agents));
    while (draft_.task_count() < request_.tasks) {
      if (row >= scenario_.rows.size()) fail_for_lack_of_rows();
      const Position cell = scenario_.rows[row++].start;
      std::vector<int> able = agents_that_reach(cell);
      if (able.empty() || draft_.has_task_on(grid_.cell(cell))) continue;
      draft_.add_task(grid_.cell(cell), std::move(able));
    }
  }

  [[noreturn]] void fail_for_lack_of_rows() const {
    fail("", fmt::format("has {} rows, enough for {} of {} tasks; they are taken from row {} on",
                         scenario_.rows.size(), draft_.task_count(), request_.tasks,
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

  const Grid& grid_;
  const Scenario& scenario_;
  const InstanceRequest& request_;
  std::vector<int> component_;
  InstanceDraft draft_;
};

}  // namespace

std::string Extras::suffix() const {
  std::string text;
  if (turn_steps > 0) text += turn_steps > 1 ? fmt::format("_turning{}", turn_steps) : "_turning";
  if (goal_headings) text += "_headings";
  if (durations.max > 0) text += fmt::format("_d{}-{}", durations.min, durations.max);
  return text;
}

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

}  // namespace grove::detail
