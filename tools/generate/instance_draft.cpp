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
  random_.shuffle(able);
  const std::size_t count = 1 + random_.below(kMaxAgentsPerTask);
  able.resize(std::min(able.size(), count));
  std::ranges::sort(able);
  tasks_.push_back({place, std::move(able)});
}

void InstanceDraft::turn_goals_into_tasks() {
  for (int i = 0; i < request_.agents; ++i) {
    const auto found = std::ranges::find(tasks_, agents_[i].goal, &DrawnTask::place);
    DrawnTask& task =
        found != tasks_.end() ? *found : tasks_.emplace_back(DrawnTask{agents_[i].goal, {}});
    if (std::ranges::find(task.agents, i) == task.agents.end()) task.agents.push_back(i);
  }
}

// Draws headings with a random generator of their own, so that no other part of the instance
// depends on them.
void InstanceDraft::add_agents(InstanceBuilder& builder) const {
  Random random = random_for(RandomUse::kMotion, request_.seed);
  for (int i = 0; i < request_.agents; ++i) {
    const Heading heading = draw_heading(random);
    const Heading goal_heading = draw_heading(random);
    try {
      builder.add_agent(spec(i, heading, goal_heading));
    } catch (const InstanceError& error) {
      fail(fmt::format("{}, {}", agents_[i].row, error.field()), error.what());
    }
  }
}

AgentSpec InstanceDraft::spec(int agent, Heading heading, Heading goal_heading) const {
  const DrawnAgent& drawn = agents_[agent];
  AgentSpec spec{.id = agent_id(agent), .start = {.place = drawn.start}, .goal = std::nullopt};
  if (!request_.mg) spec.goal = drawn.goal;
  if (request_.extras.turn_steps == 0) return spec;
  spec.motion = {request_.extras.turn_steps};
  spec.start.heading = spec.start.to = heading;
  if (request_.extras.goal_headings && spec.goal) spec.goal_heading = goal_heading;
  return spec;
}

void InstanceDraft::add_tasks(InstanceBuilder& builder) const {
  const auto [least, most] = request_.extras.durations;
  Random random = random_for(RandomUse::kDurations, request_.seed);
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    std::vector<std::string> ids;
    for (int agent : tasks_[k].agents) ids.push_back(agent_id(agent));
    const Time duration = least + random.below(most - least + 1);
    try {
      builder.add_task(fmt::format("t{}", k), tasks_[k].place, ids, duration);
    } catch (const InstanceError& error) {
      fail("", fmt::format("{} tasks for {} agents do not fit: {}", request_.tasks, request_.agents,
                           error.what()));
    }
  }
}

Instance InstanceDraft::build(Map map) && {
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
