// SPDX-License-Identifier: MIT
#include "tools/generate/instance_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "io/input_error.h"

namespace grove::detail {
namespace {

constexpr int kMaxAgentsPerTask = 3;

std::string agent_id(int i) {
  return fmt::format("a{}", i);
}

Heading draw_heading(Random& random) {
  return kHeadings[random.below(kHeadings.size())];
}

}  // namespace

InstanceDraft::InstanceDraft(std::string file, std::vector<DrawnAgent> agents,
                             const InstanceRequest& request)
    : file_(std::move(file)),
      agents_(std::move(agents)),
      request_(request),
      random_(random_for(RandomUse::kTasks, request.seed)) {}

void InstanceDraft::fail(const std::string& place, const std::string& message) const {
  throw InputError(file_, place, message);
}

bool InstanceDraft::has_task_on(Place place) const {
  return std::ranges::find(tasks_, place, &DrawnTask::place) != tasks_.end();
}

void InstanceDraft::add_task(Place place, std::vector<int> able) {
  DrawnTask task{place, {}};
  if (request_.choices.need > 0) task.able = able;
  random_.shuffle(able);
  const std::size_t count = 1 + random_.below(kMaxAgentsPerTask);
  able.resize(std::min(able.size(), count));
  std::ranges::sort(able);
  task.agents = std::move(able);
  tasks_.push_back(std::move(task));
}

// Draws the agents of every task, so that those of a task do not depend on which tasks get the need.
void InstanceDraft::give_needs() {
  const Choices& choices = request_.choices;
  if (choices.need == 0) return;
  Random random = random_for(RandomUse::kNeeds, request_.seed);
  const std::vector<int> drawn = draw_share(choices.need_share, task_count(), random);
  std::vector<bool> gets_need(tasks_.size());
  for (const int task : drawn) gets_need[task] = true;
  for (int k = 0; k < task_count(); ++k) {
    std::vector<int> agents = std::move(tasks_[k].able);
    const int least = std::max(choices.need, choices.eligible);
    if (gets_need[k] && std::ssize(agents) < least)
      fail("", fmt::format("task 't{}' can be reached by {} of the agents; expected at least {}", k,
                           agents.size(), least));
    if (choices.eligible > 0) {
      random.shuffle(agents);
      agents.resize(std::min(agents.size(), static_cast<std::size_t>(choices.eligible)));
      std::ranges::sort(agents);
    }
    if (!gets_need[k]) continue;
    tasks_[k].agents = std::move(agents);
    tasks_[k].need = choices.need;
  }
}

// A goal on the place of a task with a need becomes a task of its own, because its agent must visit
// it.
void InstanceDraft::turn_goals_into_tasks() {
  for (int i = 0; i < request_.agents; ++i) {
    const auto found = std::ranges::find_if(tasks_, [&](const DrawnTask& task) {
      return task.place == agents_[i].goal && task.need == 0;
    });
    DrawnTask& task =
        found != tasks_.end() ? *found : tasks_.emplace_back(DrawnTask{agents_[i].goal, {}});
    if (std::ranges::find(task.agents, i) == task.agents.end()) task.agents.push_back(i);
  }
}

// Draws headings with a random generator of their own, so that no other part of the instance
// depends on them.
void InstanceDraft::add_agents(InstanceBuilder& builder) const {
  Random random = random_for(RandomUse::kMotion, request_.seed);
  Random random_goals = random_for(RandomUse::kGoals, request_.seed);
  const std::vector<std::vector<int>> goals =
      draw_goals(request_.choices, request_.agents, random_goals);
  for (int i = 0; i < request_.agents; ++i) {
    const Heading heading = draw_heading(random);
    const Heading goal_heading = draw_heading(random);
    try {
      builder.add_agent(spec(i, goals[i], heading, goal_heading));
    } catch (const InstanceError& error) {
      fail(fmt::format("{}, {}", agents_[i].row, error.field()), error.what());
    }
  }
}

// `goals`: the agents whose drawn goals the agent may choose.
AgentSpec InstanceDraft::spec(int agent, const std::vector<int>& goals, Heading heading,
                              Heading goal_heading) const {
  const DrawnAgent& drawn = agents_[agent];
  AgentSpec spec{.id = agent_id(agent), .start = {.place = drawn.start}, .goal = std::nullopt};
  if (!request_.mg && goals.size() == 1) spec.goal = drawn.goal;
  if (!request_.mg && goals.size() > 1)
    for (const int other : goals) spec.goals.push_back(agents_[other].goal);
  if (request_.extras.turn_steps == 0) return spec;
  spec.motion = {request_.extras.turn_steps};
  spec.start.heading = spec.start.to = heading;
  if (request_.extras.goal_headings && !request_.mg) spec.goal_heading = goal_heading;
  return spec;
}

void InstanceDraft::add_tasks(InstanceBuilder& builder) const {
  const auto [least, most] = request_.extras.durations;
  Random random = random_for(RandomUse::kDurations, request_.seed);
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    std::vector<std::string> ids;
    for (int agent : tasks_[k].agents) ids.push_back(agent_id(agent));
    const Time duration = least + random.below(most - least + 1);
    const auto need = tasks_[k].need > 0 ? std::optional(tasks_[k].need) : std::nullopt;
    try {
      builder.add_task(fmt::format("t{}", k), tasks_[k].place, ids, duration, need);
    } catch (const InstanceError& error) {
      fail("", fmt::format("{} tasks for {} agents do not fit: {}", request_.tasks, request_.agents,
                           error.what()));
    }
  }
}

Instance InstanceDraft::build(Map map) && {
  give_needs();
  if (request_.mg) turn_goals_into_tasks();
  InstanceBuilder builder(std::move(map));
  add_agents(builder);
  add_tasks(builder);
  try {
    return std::move(builder).build();
  } catch (const InstanceError& error) {
    fail("", error.what());
  }
}

}  // namespace grove::detail
