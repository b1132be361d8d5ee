// SPDX-License-Identifier: MIT
#include "model/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

bool references_agree(const Instance& instance) {
  std::size_t named = 0;
  std::size_t held = 0;
  for (TaskIndex index = 0; index < instance.task_count(); ++index) {
    const Task& task = instance.task(index);
    for (const AgentIndex agent : task.agents) {
      const Agent& a = instance.agent(agent);
      if (!std::ranges::binary_search(task.needs_all() ? a.tasks : a.options, index)) return false;
    }
    named += task.agents.size();
  }
  for (const Agent& agent : instance.agents()) held += agent.tasks.size() + agent.options.size();
  return named == held;
}

void require_new_id(const std::string& id, bool is_new) {
  if (id.empty()) throw InstanceError("id", "expected an id that is not empty");
  if (!is_new)
    throw InstanceError("id", fmt::format("id '{}' is used twice; expected distinct ids", id));
}

}  // namespace

std::vector<Place> Agent::destinations() const {
  std::vector<Place> places = goals;
  if (goal) places.push_back(*goal);
  return places;
}

Instance::Instance(std::shared_ptr<const Map> map) : map_(std::move(map)), world_(&ground(*map_)) {}

AgentSpec Instance::spec(AgentIndex agent) const {
  const Agent& a = agents_[agent];
  AgentSpec spec{.id = a.id,
                 .start = pose_of(a.start),
                 .goal = a.goal,
                 .motion = a.motion,
                 .goal_heading = a.goal_heading,
                 .goals = a.goals};
  if (world_->is_working(a.start)) {
    const Work& work = world_->work(a.start);
    spec.working = WorkBegun{tasks_[work.task].id, work.done};
  }
  return spec;
}

std::vector<std::string> Instance::agent_ids() const {
  std::vector<std::string> ids;
  for (const Agent& agent : agents_) ids.push_back(agent.id);
  return ids;
}

bool Instance::has_choices() const {
  return std::ranges::any_of(agents_, &Agent::has_choice);
}

bool Instance::rests_on_last_stop(AgentIndex agent) const {
  const Agent& a = agents_[agent];
  return !a.has_destination() && !a.tasks.empty() &&
         std::ranges::all_of(a.tasks, [&](TaskIndex t) { return tasks_[t].duration == 0; });
}

bool Instance::may_rest(AgentIndex agent, State state) const {
  const Agent& a = agents_[agent];
  if (a.is_idle()) return true;
  const Place place = world_->place(state);
  if (!a.has_destination())
    return std::ranges::any_of(a.tasks, [&](TaskIndex t) { return tasks_[t].cell == place; });
  const bool is_there = a.goal ? place == *a.goal : std::ranges::count(a.goals, place) > 0;
  if (!is_there || !a.goal_heading) return is_there;
  const State base = world_->base(state);
  if (world_->kind(base) != a.kind) return false;
  const Pose pose = motion_world_->pose(base);
  return pose.steps == 0 && pose.heading == *a.goal_heading;
}

std::vector<State> Instance::states_visiting(TaskIndex task) const {
  std::vector<State> states;
  world_->for_each_state(tasks_[task].cell, [&](State state) {
    if (is_visited(task, state)) states.push_back(state);
  });
  return states;
}

std::vector<State> Instance::states_to_rest(AgentIndex agent) const {
  const Agent& a = agents_[agent];
  std::vector<Place> places = a.destinations();
  for (const TaskIndex task : a.tasks)
    if (!a.has_destination()) places.push_back(tasks_[task].cell);
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<State> states;
  for (const Place place : places)
    world_->for_each_state(place, [&](State state) {
      if (may_rest(agent, state)) states.push_back(state);
    });
  return states;
}

// Tasks that are not stops come immediately before the agent's first stop on their place.
std::vector<TaskIndex> Instance::tasks_in_order(AgentIndex agent,
                                                std::span<const std::uint8_t> stops) const {
  const Agent& a = agents_[agent];
  std::vector<TaskIndex> order;
  for (const std::uint8_t stop : stops) {
    const TaskIndex task = a.stops[stop];
    const auto is_here = [&](TaskIndex t) { return tasks_[t].cell == tasks_[task].cell; };
    if (a.stops.size() < a.tasks.size() && *std::ranges::find_if(a.stops, is_here) == task)
      for (const TaskIndex other : a.tasks)
        if (is_here(other) && std::ranges::count(a.stops, other) == 0) order.push_back(other);
    order.push_back(task);
  }
  return order;
}

InstanceBuilder::InstanceBuilder(Map map)
    : InstanceBuilder(std::make_shared<const Map>(std::move(map))) {}
InstanceBuilder::InstanceBuilder(std::shared_ptr<const Map> map) : instance_(std::move(map)) {}

InstanceBuilder InstanceBuilder::like(const Instance& instance) {
  InstanceBuilder builder(instance.shared_map());
  if (!instance.may_follow()) builder.forbid_following();
  return builder;
}

std::string InstanceBuilder::name(Place place) const {
  return (instance_.is_on_grid() ? "cell " : "place ") + instance_.world().name(place);
}

Cell InstanceBuilder::passable_cell(const std::string& field, Position p) const {
  const Grid& grid = instance_.grid();
  if (!grid.contains(p))
    throw InstanceError(
        field, fmt::format("cell [{}, {}] is outside the map; expected [x, y] (column, row) "
                           "with x in 0..{} and y in 0..{}",
                           p.x, p.y, grid.width() - 1, grid.height() - 1));
  if (!grid.passable(grid.cell(p)))
    throw InstanceError(
        field,
        fmt::format("cell [{}, {}] is blocked on the map; expected a passable cell", p.x, p.y));
  return grid.cell(p);
}

AgentIndex InstanceBuilder::add_agent(std::string id, Position start,
                                      std::optional<Position> goal) {
  require_new_id(id, !agent_by_id_.contains(id));
  const Cell from = passable_cell("start", start);
  const auto to = goal ? std::optional(passable_cell("goal", *goal)) : std::nullopt;
  return add_agent(std::move(id), from, to);
}

AgentIndex InstanceBuilder::add_agent(std::string id, Place start, std::optional<Place> goal) {
  return add_agent({.id = std::move(id), .start = {.place = start}, .goal = goal});
}

AgentIndex InstanceBuilder::add_agent(AgentSpec spec) {
  require_new_id(spec.id, !agent_by_id_.contains(spec.id));
  const Place from = spec.start.place;
  if (instance_.is_on_grid()) {
    const Grid& grid = instance_.grid();
    passable_cell("start", grid.position(from));
    if (spec.goal) passable_cell("goal", grid.position(*spec.goal));
    for (std::size_t k = 0; k < spec.goals.size(); ++k)
      passable_cell(fmt::format("goals/{}", k), grid.position(spec.goals[k]));
  }
  if (const auto it = agent_by_start_.find(from); it != agent_by_start_.end())
    throw InstanceError(
        "start", fmt::format("{} is already the start of agent '{}'; expected distinct starts",
                             name(from), instance_.agent(it->second).id));
  if (spec.goal) {
    if (const auto it = agent_by_goal_.find(*spec.goal); it != agent_by_goal_.end())
      throw InstanceError(
          "goal", fmt::format("{} is already the goal of agent '{}'; expected distinct goals",
                              name(*spec.goal), instance_.agent(it->second).id));
  }
  require_choice_of_goals(spec);

  if (spec.start.steps != 0 && (spec.start.steps < 0 || spec.start.steps >= spec.motion.turn_steps))
    throw InstanceError("start", fmt::format("found {} steps of a turn of {} steps; expected fewer",
                                             spec.start.steps, spec.motion.turn_steps));

  Agent agent{.id = spec.id,
              .goal = spec.goal,
              .goals = spec.goals,
              .goal_heading = spec.goal_heading,
              .motion = spec.motion};
  if (spec.motion.turn_steps > 0) {
    const auto known = std::ranges::find(motions_, spec.motion) - motions_.begin();
    if (known == std::ssize(motions_)) motions_.push_back(spec.motion);
    agent.kind = static_cast<int>(known) + 1;
  }
  const auto index = static_cast<AgentIndex>(instance_.agents_.size());
  agent_by_id_.emplace(agent.id, index);
  agent_by_start_.emplace(from, index);
  if (agent.goal) agent_by_goal_.emplace(*agent.goal, index);
  instance_.agents_.push_back(std::move(agent));
  specs_.push_back(std::move(spec));
  return index;
}

void InstanceBuilder::require_choice_of_goals(const AgentSpec& spec) const {
  if (spec.goal && !spec.goals.empty())
    throw InstanceError("goals", "found both 'goal' and 'goals'; expected one of them");
  for (std::size_t k = 0; k < spec.goals.size(); ++k)
    if (std::ranges::count(std::span(spec.goals).first(k), spec.goals[k]) > 0)
      throw InstanceError(
          fmt::format("goals/{}", k),
          fmt::format("{} is listed twice; expected each place once", name(spec.goals[k])));
}

TaskIndex InstanceBuilder::add_task(std::string id, Position cell,
                                    std::span<const std::string> agent_ids, Time duration,
                                    std::optional<int> need) {
  require_new_id(id, !task_by_id_.contains(id));
  const Cell place = passable_cell("cell", cell);
  return add_task(std::move(id), place, agent_ids, duration, need);
}

TaskIndex InstanceBuilder::add_task(std::string id, Place place,
                                    std::span<const std::string> agent_ids, Time duration,
                                    std::optional<int> need) {
  require_new_id(id, !task_by_id_.contains(id));
  if (instance_.is_on_grid()) passable_cell("cell", instance_.grid().position(place));
  const int agents = static_cast<int>(agent_ids.size());
  Task task{std::move(id), place, {}, duration, need.value_or(agents)};
  if (duration < 0 || duration > kMaxDuration)
    throw InstanceError("duration",
                        fmt::format("found {} steps; expected 0 to {}", duration, kMaxDuration));
  if (agent_ids.empty()) throw InstanceError("agents", "expected at least one agent");
  if (task.need < 1 || task.need > agents)
    throw InstanceError("need",
                        fmt::format("found {}; expected 1 to {}, the number of agents of the task",
                                    task.need, agents));

  std::vector<bool> is_listed(instance_.agents_.size());
  task.agents.reserve(agent_ids.size());
  for (std::size_t k = 0; k < agent_ids.size(); ++k) {
    const std::string field = fmt::format("agents/{}", k);
    const auto it = agent_by_id_.find(agent_ids[k]);
    if (it == agent_by_id_.end())
      throw InstanceError(
          field, fmt::format("there is no agent '{}'; expected the id of an agent of this instance",
                             agent_ids[k]));
    if (is_listed[it->second])
      throw InstanceError(
          field, fmt::format("agent '{}' is listed twice; expected each agent once", agent_ids[k]));
    if (task.need == agents && instance_.agent(it->second).tasks.size() >= kMaxTasksPerAgent)
      throw InstanceError(
          field, fmt::format("agent '{}' must visit more than {} tasks; expected at most {}",
                             agent_ids[k], kMaxTasksPerAgent, kMaxTasksPerAgent));
    is_listed[it->second] = true;
    task.agents.push_back(it->second);
  }

  const auto index = static_cast<TaskIndex>(instance_.tasks_.size());
  for (AgentIndex index_of_agent : task.agents) {
    Agent& agent = instance_.agents_[index_of_agent];
    (task.needs_all() ? agent.tasks : agent.options).push_back(index);
  }
  task_by_id_.emplace(task.id, index);
  instance_.tasks_.push_back(std::move(task));
  return index;
}

Instance InstanceBuilder::build() && {
  if (instance_.agents_.empty()) throw InstanceError("agents", "expected at least one agent");
  for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
    choose_stops(i);
    if (specs_[i].working) require_work(i, *specs_[i].working);
  }
  make_world();
  GROVE_ASSERT(references_agree(instance_),
               "a task names an agent if and only if the agent has it");
  return std::move(instance_);
}

void InstanceBuilder::choose_stops(AgentIndex index) {
  Agent& agent = instance_.agents_[index];
  const bool leaves_out_stops = leaves_out_stops_.contains(index);
  const auto takes_time = [&](TaskIndex t) { return instance_.task(t).duration > 0; };
  for (const TaskIndex task : agent.tasks) {
    const auto is_here = [&](TaskIndex t) {
      return instance_.task(t).cell == instance_.task(task).cell;
    };
    const auto first_without_time = std::ranges::find_if(
        agent.tasks, [&](TaskIndex t) { return is_here(t) && !takes_time(t); });
    const bool work_here =
        std::ranges::any_of(agent.tasks, [&](TaskIndex t) { return is_here(t) && takes_time(t); });
    if (takes_time(task) || ((!work_here || leaves_out_stops) && *first_without_time == task))
      agent.stops.push_back(task);
  }
  GROVE_ASSERT(std::ranges::all_of(agent.tasks,
                                   [&](TaskIndex t) {
                                     return std::ranges::any_of(agent.stops, [&](TaskIndex stop) {
                                       return instance_.task(stop).cell == instance_.task(t).cell;
                                     });
                                   }),
               "an agent has a stop on the place of each of its tasks");
}

void InstanceBuilder::require_work(AgentIndex agent, const WorkBegun& begun) const {
  const Agent& a = instance_.agent(agent);
  const auto fail = [&](const std::string& key, const std::string& message) {
    throw InstanceError(fmt::format("agents/{}/working/{}", agent, key), message);
  };
  const auto found = task_by_id_.find(begun.task);
  if (found == task_by_id_.end())
    fail("task",
         fmt::format("there is no task '{}'; expected a task of agent '{}'", begun.task, a.id));
  const Task& task = instance_.task(found->second);
  if (std::ranges::count(task.agents, agent) == 0)
    fail("task", fmt::format("task '{}' is not a task of agent '{}'; expected one of its tasks",
                             begun.task, a.id));
  if (task.cell != specs_[agent].start.place)
    fail("task", fmt::format("agent '{}' does not start on {}; expected a task on its start", a.id,
                             name(task.cell)));
  if (task.duration == 0)
    fail("task",
         fmt::format("task '{}' takes no time; expected a task with a duration", begun.task));
  if (begun.done < 0 || begun.done >= task.duration)
    fail("done",
         fmt::format("found {} steps of task '{}'; expected 0 to {}, less than its duration",
                     begun.done, begun.task, task.duration - 1));
}

// An agent may work in any heading. Within a turn, states of work are needed only for the pose in
// which the agent starts, because the agent can work in this pose, or before any other turn.
std::vector<MotionWorld::Job> InstanceBuilder::jobs() const {
  std::vector<MotionWorld::Job> jobs;
  const auto state_of = [&](int kind, const Pose& pose) {
    return MotionWorld::base_state(instance_.map(), motions_, kind, pose);
  };
  std::size_t of_task = 0;  // index of the first job of the current task
  const auto add = [&](TaskIndex task, State base) -> MotionWorld::Job& {
    for (std::size_t j = of_task; j < jobs.size(); ++j)
      if (jobs[j].base == base) return jobs[j];
    return jobs.emplace_back(MotionWorld::Job{task, instance_.task(task).duration, base});
  };
  for (TaskIndex t = 0; t < instance_.task_count(); ++t) {
    const Task& task = instance_.task(t);
    if (task.duration == 0) continue;
    of_task = jobs.size();
    for (const AgentIndex agent : task.agents) {
      const int kind = instance_.agent(agent).kind;
      for (const Heading heading : kHeadings)
        if (kind > 0 || heading == Heading::kNorth)
          add(t, state_of(kind, {task.cell, heading, heading, 0}));
      const AgentSpec& spec = specs_[agent];
      if (spec.start.place != task.cell) continue;
      MotionWorld::Job& job = add(t, state_of(kind, spec.start));
      if (spec.working && spec.working->task == task.id && spec.working->done == 0)
        job.has_initial_state = true;
    }
  }
  return jobs;
}

void InstanceBuilder::make_world() {
  const std::vector<MotionWorld::Job> jobs = this->jobs();
  if (!motions_.empty() || !jobs.empty()) {
    try {
      instance_.motion_world_ = std::make_shared<const MotionWorld>(instance_.map_, motions_, jobs);
    } catch (const std::invalid_argument& error) {
      throw InstanceError(instance_.is_on_grid() ? "map" : "roadmap", error.what());
    }
    instance_.world_ = instance_.motion_world_.get();
  }
  for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
    Agent& agent = instance_.agents_[i];
    const AgentSpec& spec = specs_[i];
    agent.start = MotionWorld::base_state(instance_.map(), motions_, agent.kind, spec.start);
    if (spec.working)
      agent.start = instance_.motion_world_->working(task_by_id_.at(spec.working->task),
                                                     agent.start, spec.working->done);
    GROVE_CHECK(instance_.world().place(agent.start) == spec.start.place,
                "an agent starts on the place of its specification");
    GROVE_CHECK(instance_.world().kind(agent.start) == agent.kind,
                "an agent starts in a state of its kind");
  }
}

}  // namespace grove::detail
