// SPDX-License-Identifier: MIT
#include "grove/instance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "api/access.h"
#include "io/instance_file.h"
#include "io/map_file.h"
#include "io/roadmap_file.h"

namespace grove {
namespace {

detail::Heading heading_of(Heading heading) {
  return static_cast<detail::Heading>(heading);
}
Heading public_heading(detail::Heading heading) {
  return static_cast<Heading>(heading);
}

detail::AgentSpec spec_of(const detail::Map& map, const Agent& agent, const std::string& field) {
  detail::AgentSpec spec{
      .id = agent.id, .start = {}, .goal = std::nullopt, .motion = {agent.turn_steps}};
  spec.start = pose_of(map, spec.motion, agent.start, field + "/start");
  if (agent.goal) spec.goal = place_of(map, *agent.goal, field + "/goal");
  for (const Place& goal : agent.goals)
    spec.goals.push_back(place_of(map, goal, fmt::format("{}/goals/{}", field, spec.goals.size())));
  if (agent.goal_heading) spec.goal_heading = heading_of(*agent.goal_heading);
  if (agent.working) spec.working = {agent.working->task, agent.working->done};
  return spec;
}

// Calls `add`. The builder's errors name the field within an item; this function prepends `field`,
// the JSON Pointer of the item.
template <class Add>
void added(const std::string& field, Add&& add) {
  try {
    add();
  } catch (const detail::InstanceError& error) {
    throw InvalidArgument(public_field(field + (error.field().empty() ? "" : "/" + error.field())),
                          error.what());
  }
}

std::vector<std::string> ids_of(const std::vector<Agent>& agents) {
  std::vector<std::string> ids;
  for (const Agent& agent : agents) ids.push_back(agent.id);
  return ids;
}

// Lists all agents in the tasks of all agents.
std::vector<Task> with_agents(std::vector<Task> tasks, const std::vector<Agent>& agents) {
  const std::vector<std::string> ids = ids_of(agents);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (!tasks[i].all_agents) continue;
    if (!tasks[i].agents.empty() && !std::ranges::is_permutation(tasks[i].agents, ids))
      throw InvalidArgument(fmt::format("/tasks/{}/agents", i),
                            fmt::format("found a list of {} agents, and all_agents; expected one "
                                        "of them",
                                        tasks[i].agents.size()));
    tasks[i].agents = ids;
  }
  return tasks;
}

detail::Instance built(const World& world, const std::vector<Agent>& agents,
                       const std::vector<Task>& tasks, Rules rules) {
  const detail::Map& map = *Access::map(world);
  detail::InstanceBuilder builder(Access::map(world));
  if (!rules.following) builder.forbid_following();
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const std::string field = fmt::format("/agents/{}", i);
    added(field, [&] { builder.add_agent(spec_of(map, agents[i], field)); });
  }
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::string field = fmt::format("/tasks/{}", i);
    const detail::Place place = place_of(map, tasks[i].place, field + "/place");
    added(field, [&] {
      builder.add_task(tasks[i].id, place, tasks[i].agents, tasks[i].duration, tasks[i].need);
    });
  }
  return with_public_exceptions([&] { return std::move(builder).build(); });
}

Agent public_agent(const detail::Instance& instance, detail::AgentIndex index) {
  const detail::AgentSpec spec = instance.spec(index);
  const detail::Map& map = instance.map();
  Agent agent{.id = spec.id,
              .start = public_pose(map, spec.motion, spec.start),
              .turn_steps = spec.motion.turn_steps};
  if (spec.goal) agent.goal = public_place(map, *spec.goal);
  for (const detail::Place goal : spec.goals) agent.goals.push_back(public_place(map, goal));
  if (spec.goal_heading) agent.goal_heading = public_heading(*spec.goal_heading);
  if (spec.working) agent.working = WorkBegun{spec.working->task, spec.working->done};
  return agent;
}

Task public_task(const detail::Instance& instance, const detail::Task& task) {
  Task to_public{.id = task.id,
                 .place = public_place(instance.map(), task.cell),
                 .agents = {},
                 .duration = task.duration};
  for (const detail::AgentIndex agent : task.agents)
    to_public.agents.push_back(instance.agent(agent).id);
  if (task.needs_all()) return to_public;
  to_public.need = task.need;
  to_public.all_agents = std::ssize(task.agents) == instance.agent_count();
  return to_public;
}

detail::InputRules rules_of(const Trust& trust) {
  detail::InputRules rules{.confined = trust.confine};
  if (trust.memory_limit) rules.memory = *trust.memory_limit;
  return rules;
}

Instance loaded(detail::LoadedInstance read, std::vector<std::string>* warnings) {
  if (warnings != nullptr)
    warnings->insert(warnings->end(), read.warnings.begin(), read.warnings.end());
  return Access::to_public(std::move(read.instance));
}

}  // namespace

std::string public_field(std::string field) {
  constexpr std::string_view kCell = "/cell";
  if (field.ends_with(kCell)) field.replace(field.size() - kCell.size(), kCell.size(), "/place");
  return field;
}

Instance Access::to_public(detail::Instance instance) {
  std::vector<Agent> agents;
  for (detail::AgentIndex i = 0; i < instance.agent_count(); ++i)
    agents.push_back(public_agent(instance, i));
  std::vector<Task> tasks;
  for (const detail::Task& task : instance.tasks()) tasks.push_back(public_task(instance, task));
  World world = Access::world(instance.shared_map());
  return Instance(std::make_shared<const Instance::Data>(
      Instance::Data{std::move(world), std::move(agents), std::move(tasks), std::move(instance)}));
}

Instance::Instance(World world, std::vector<Agent> agents, std::vector<Task> tasks, Rules rules) {
  tasks = with_agents(std::move(tasks), agents);
  detail::Instance instance = built(world, agents, tasks, rules);
  data_ = std::make_shared<const Data>(
      Data{std::move(world), std::move(agents), std::move(tasks), std::move(instance)});
}

World Instance::world() const {
  return data_->world;
}
const std::vector<Agent>& Instance::agents() const {
  return data_->agents;
}
const std::vector<Task>& Instance::tasks() const {
  return data_->tasks;
}
bool Instance::has_choices() const {
  return data_->instance.has_choices();
}
Rules Instance::rules() const {
  return {.following = data_->instance.may_follow()};
}

detail::Pose pose_of(const detail::Map& map, detail::Motion motion, const Pose& pose,
                     const std::string& field) {
  detail::Pose made{.place = place_of(map, pose.place, field)};
  if (motion.turn_steps == 0) {
    if (pose.heading || pose.turning_to || pose.turn_steps_done != 0)
      throw InvalidArgument(field, "found a heading; expected none for a robot without turn_steps");
    return made;
  }
  if (!pose.heading)
    throw InvalidArgument(field, "found no heading; expected one for a robot with turn_steps");
  made.heading = made.to = heading_of(*pose.heading);
  if (!pose.turning_to) return made;
  made.to = heading_of(*pose.turning_to);
  made.steps = pose.turn_steps_done;
  const bool is_next =
      made.to == detail::right_of(made.heading) || made.to == detail::left_of(made.heading);
  if (!is_next) throw InvalidArgument(field, "found a turn that is not a quarter turn");
  if (made.steps < 1 || made.steps >= motion.turn_steps)
    throw InvalidArgument(field, fmt::format("found {} steps of a turn; expected from 1 to {}",
                                             made.steps, motion.turn_steps - 1));
  return made;
}

Pose public_pose(const detail::Map& map, detail::Motion motion, const detail::Pose& pose) {
  Pose to_public{.place = public_place(map, pose.place)};
  if (motion.turn_steps == 0) return to_public;
  to_public.heading = public_heading(pose.heading);
  if (pose.steps == 0) return to_public;
  to_public.turning_to = public_heading(pose.to);
  to_public.turn_steps_done = pose.steps;
  return to_public;
}

Instance read_instance(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  return with_public_exceptions([&] { return loaded(detail::read_instance(path), warnings); });
}

Instance read_instance(const std::filesystem::path& path, const Trust& trust,
                       std::vector<std::string>* warnings) {
  return with_public_exceptions(
      [&] { return loaded(detail::read_instance(path, rules_of(trust)), warnings); });
}

Instance parse_instance(std::string_view text, const std::filesystem::path& folder,
                        const Trust& trust, std::vector<std::string>* warnings) {
  return with_public_exceptions([&] {
    return loaded(detail::parse_instance(text, "the instance", folder, rules_of(trust)), warnings);
  });
}

Instance parse_instance(std::string_view text, const std::filesystem::path& folder,
                        std::vector<std::string>* warnings) {
  return with_public_exceptions(
      [&] { return loaded(detail::parse_instance(text, "the instance", folder), warnings); });
}

Instance parse_instance(std::string_view text, const World& world, Rules rules) {
  return with_public_exceptions([&] {
    detail::InstanceBuilder builder(Access::map(world));
    if (!rules.following) builder.forbid_following();
    return Access::to_public(detail::parse_instance_on(std::move(builder), text, "the instance"));
  });
}

std::string instance_text(const Instance& instance) {
  return with_public_exceptions(
      [&] { return detail::instance_text(Access::instance(instance), ""); });
}

Instance read_scenario(const std::filesystem::path& scenario, const std::filesystem::path& map,
                       int agents) {
  return with_public_exceptions(
      [&] { return loaded(detail::read_scenario_instance(scenario, map, agents), nullptr); });
}

void write_instance(const std::filesystem::path& path, const Instance& instance) {
  with_public_exceptions([&] {
    const detail::Instance& inner = Access::instance(instance);
    const std::string name = path.filename().string();
    const std::string stem = name.substr(0, name.find('.'));
    const std::string map = stem + (inner.is_on_grid() ? ".map" : ".roadmap.json");
    if (inner.is_on_grid())
      detail::write_map(path.parent_path() / map, inner.grid());
    else
      detail::write_roadmap(path.parent_path() / map, *inner.roadmap());
    detail::write_instance(path, inner, map);
  });
}

}  // namespace grove
