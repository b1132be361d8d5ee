// SPDX-License-Identifier: MIT
#include "tests/support/random_choices.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "model/random.h"

namespace grove::detail {
namespace {

// Its own goal, goals of other agents, and places of tasks.
std::vector<Place> random_goals(const Instance& instance, const Agent& agent, Random& random) {
  std::vector<Place> goals{*agent.goal};
  for (const Agent& other : instance.agents())
    if (other.goal && random.below(2) == 0) goals.push_back(*other.goal);
  for (const Task& task : instance.tasks())
    if (random.below(4) == 0) goals.push_back(task.cell);
  std::ranges::sort(goals);
  goals.erase(std::unique(goals.begin(), goals.end()), goals.end());
  return goals;
}

std::vector<std::string> random_agents(const Instance& instance, const Task& task, bool more,
                                       Random& random) {
  std::vector<std::string> ids;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
    if (std::ranges::count(task.agents, agent) > 0 || (more && random.below(2) == 0))
      ids.push_back(instance.agent(agent).id);
  return ids;
}

// Adds up to two further tasks on the places of tasks, some of which take time.
void add_on_same_places(const Instance& instance, Random& random, InstanceBuilder& builder) {
  constexpr int kShares = 3;
  if (instance.task_count() == 0 || random.below(kShares) > 0) return;
  for (int more = 1 + random.below(2); more > 0; --more) {
    const Task& task = instance.task(random.below(instance.task_count()));
    const std::vector<std::string> ids = random_agents(instance, task, true, random);
    const Time duration = random.below(3) == 0 ? 1 + random.below(2) : 0;
    builder.add_task("also" + std::to_string(more), task.cell, ids, duration,
                     1 + random.below(static_cast<int>(ids.size())));
  }
}

}  // namespace

Instance with_random_choices(const Instance& instance, std::uint64_t seed) {
  Random random(seed);
  const bool has_goals = random.below(2) == 0;
  const bool has_needs = !has_goals || random.below(2) == 0;
  InstanceBuilder builder = InstanceBuilder::like(instance);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    AgentSpec spec = instance.spec(i);
    if (has_goals && spec.goal && random.below(3) > 0) {
      spec.goals = random_goals(instance, instance.agent(i), random);
      spec.goal.reset();
    }
    builder.add_agent(std::move(spec));
  }
  for (const Task& task : instance.tasks()) {
    const bool more = has_needs && random.below(3) > 0;
    const std::vector<std::string> ids = random_agents(instance, task, more, random);
    const int count = static_cast<int>(ids.size());
    builder.add_task(task.id, task.cell, ids, task.duration,
                     more ? 1 + random.below(count) : count);
  }
  if (has_needs) add_on_same_places(instance, random, builder);
  return std::move(builder).build();
}

}  // namespace grove::detail
