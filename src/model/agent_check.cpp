// SPDX-License-Identifier: MIT
// Checks one agent's plan. Like check.cpp, the code is written so that it can be compared with
// docs/design.md, section 1, and it does not use World::moves().
#include "model/agent_check.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace grove::detail {
namespace {

bool are_neighbors(const Grid& grid, Cell from, Cell to) {
  const Position a = grid.position(from);
  const Position b = grid.position(to);
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) <= 1;
}

// True if the step from `from` to `to` is a step of a quarter turn. A quarter turn leads from a
// heading to an adjacent one, through all poses within the turn. Precondition: both poses are on
// the same place.
bool is_step_of_turn(Motion motion, const Pose& from, const Pose& to) {
  const bool ends = from.steps + 1 == motion.turn_steps || motion.turn_steps == 1;
  if (ends && to.steps != 0) return false;
  if (!ends && (to.steps != from.steps + 1 || to.heading != from.heading)) return false;
  const Heading then = ends ? to.heading : to.to;
  if (from.steps > 0) return then == from.to;
  const int quarters = (static_cast<int>(then) - static_cast<int>(from.heading) + 4) % 4;
  return quarters == 1 || quarters == 3;
}

}  // namespace

AllowedSteps::AllowedSteps(const Map& map) : map_(map) {
  if (const auto* roadmap = std::get_if<Roadmap>(&map)) add_roads(*roadmap);
}

Place AllowedSteps::places() const {
  return std::visit([](const auto& map) { return map.place_count(); }, map_);
}

bool AllowedSteps::is_open(Place place) const {
  const auto* grid = std::get_if<Grid>(&map_);
  return grid == nullptr || grid->passable(place);
}

bool AllowedSteps::allow(Motion motion, const Pose& from, const Pose& to) const {
  if (from == to) return true;
  if (motion.turn_steps == 0) return lead(from.place, to.place);
  if (from.place == to.place) return is_step_of_turn(motion, from, to);
  return from.steps == 0 && to.steps == 0 && from.heading == to.heading && is_ahead(from, to.place);
}

std::string_view AllowedSteps::rule(Motion motion) const {
  if (motion.turn_steps > 0) return "a wait, a move one cell ahead or a step of a quarter turn";
  return std::holds_alternative<Grid>(map_) ? "a wait or a move to one of 4 neighbors"
                                            : "a wait or a step along a road in its direction";
}

std::string AllowedSteps::name(Place place) const {
  return std::visit([&](const auto& map) { return map.name(place); }, map_);
}

std::string AllowedSteps::name(Motion motion, const Pose& pose) const {
  if (motion.turn_steps == 0) return name(pose.place);
  std::string text = name(pose.place);
  text.pop_back();
  text += fmt::format(", {}", letter(pose.heading));
  if (pose.steps > 0) text += fmt::format(", {}, {}", letter(pose.to), pose.steps);
  return text + "]";
}

bool AllowedSteps::lead(Place from, Place to) const {
  const auto* grid = std::get_if<Grid>(&map_);
  return grid ? are_neighbors(*grid, from, to) : on_roads_.contains({from, to});
}

// North is up, towards smaller y.
bool AllowedSteps::is_ahead(const Pose& from, Place to) const {
  const auto& grid = std::get<Grid>(map_);
  const Position a = grid.position(from.place);
  const Position b = grid.position(to);
  switch (from.heading) {
    case Heading::kNorth:
      return b.x == a.x && b.y == a.y - 1;
    case Heading::kEast:
      return b.x == a.x + 1 && b.y == a.y;
    case Heading::kSouth:
      return b.x == a.x && b.y == a.y + 1;
    case Heading::kWest:
      return b.x == a.x - 1 && b.y == a.y;
  }
  return false;
}

void AllowedSteps::add_roads(const Roadmap& roadmap) {
  for (int r = 0; r < static_cast<int>(roadmap.roads().size()); ++r)
    for (Time step = 1; step <= roadmap.roads()[r].steps; ++step) {
      const Place before = roadmap.place_on_road(r, step - 1);
      const Place after = roadmap.place_on_road(r, step);
      on_roads_.emplace(before, after);
      if (!roadmap.roads()[r].one_way) on_roads_.emplace(after, before);
    }
}

namespace {

// Checks one agent's plan. Implements check_agent().
class AgentCheck {
 public:
  AgentCheck(const Instance& instance, const AllowedSteps& steps, AgentIndex index,
             const AgentPlan& plan, ViolationReport& report)
      : instance_(instance),
        steps_(steps),
        index_(index),
        agent_(instance.agent(index)),
        plan_(plan),
        report_(report),
        place_(fmt::format("/agents/{}", index)) {}

  std::optional<Time> run() {
    if (plan_.path.empty()) {
      report_.add(place_, "agent '{}' has no path; expected one for every agent", agent_.id);
      return std::nullopt;
    }
    if (!is_in_the_world()) return std::nullopt;
    for (const State state : plan_.path) poses_.push_back(instance_.pose_of(state));
    walk();
    check_work();
    check_end();
    check_visits();
    check_sequence();
    const Time finish = finishes();
    if (plan_.cost != finish)
      report_.add(place_ + "/cost", "agent '{}' finishes at time {}, but the plan claims {}",
                  agent_.id, finish, plan_.cost);
    return finish;
  }

 private:
  std::string step_place(std::size_t time) const { return fmt::format("{}/path/{}", place_, time); }
  std::string name(const Pose& pose) const { return steps_.name(agent_.motion, pose); }
  const Pose& at(Time time) const {
    return poses_[std::min(static_cast<std::size_t>(time), poses_.size() - 1)];
  }

  bool is_in_the_world() {
    for (std::size_t t = 0; t < plan_.path.size(); ++t) {
      const State state = plan_.path[t];
      const bool is_state = state >= 0 && state < instance_.world().state_count() &&
                            !instance_.world().is_working(state) &&
                            instance_.world().kind(state) == agent_.kind;
      if (is_state) continue;
      report_.add(step_place(t), "agent '{}' is outside the map", agent_.id);
      return false;
    }
    return true;
  }

  // Checks the start, that no place is blocked, and each step.
  void walk() {
    for (std::size_t t = 0; t < poses_.size(); ++t)
      if (!steps_.is_open(poses_[t].place))
        report_.add(step_place(t), "agent '{}' is on the blocked cell {}", agent_.id,
                    steps_.name(poses_[t].place));
    const Pose start = instance_.pose_of(agent_.start);
    if (poses_.front() != start)
      report_.add(step_place(0), "agent '{}' begins on {}; expected its start {}", agent_.id,
                  name(poses_.front()), name(start));
    for (std::size_t t = 1; t < poses_.size(); ++t)
      if (!steps_.allow(agent_.motion, poses_[t - 1], poses_[t]))
        report_.add(step_place(t), "agent '{}' jumps from {} to {}; expected {}", agent_.id,
                    name(poses_[t - 1]), name(poses_[t]), steps_.rule(agent_.motion));
  }

  // Checks each task execution, that no two overlap or execute the same task, and that the
  // execution in progress at the start continues.
  void check_work() {
    for (std::size_t k = 0; k < plan_.work.size(); ++k) {
      const std::string place = fmt::format("{}/work/{}", place_, k);
      const WorkTime& work = plan_.work[k];
      check_piece(place, work);
      for (std::size_t other = 0; other < k; ++other) {
        const WorkTime& before = plan_.work[other];
        if (before.task == work.task)
          report_.add(place, "agent '{}' does task '{}' a second time; expected each once",
                      agent_.id, instance_.task(work.task).id);
        else if (instance_.task(before.task).duration > 0 &&
                 instance_.task(work.task).duration > 0 && before.begin < work.end &&
                 work.begin < before.end)
          report_.add(place, "agent '{}' works on tasks '{}' and '{}' at the same time", agent_.id,
                      instance_.task(before.task).id, instance_.task(work.task).id);
      }
    }
    const auto begun = begun_before();
    const auto continues = [&](const WorkTime& w) {
      return w.task == begun->first && w.begin == -begun->second;
    };
    if (begun && std::ranges::none_of(plan_.work, continues))
      report_.add(place_ + "/work",
                  "agent '{}' starts at work on task '{}', {} steps of it done; expected it to "
                  "continue, with begin {}",
                  agent_.id, instance_.task(begun->first).id, begun->second, -begun->second);
  }

  void check_piece(const std::string& place, const WorkTime& work) {
    const Task& task = instance_.task(work.task);
    if (std::ranges::count(task.agents, index_) == 0) {
      report_.add(place, "task '{}' does not list agent '{}'; expected a task that does", task.id,
                  agent_.id);
      return;
    }
    if (!has_stated_visits(task)) {
      report_.add(place,
                  "task '{}' takes no time and all its agents must visit it; expected only tasks "
                  "with a duration or a choice of agents",
                  task.id);
      return;
    }
    if (std::int64_t{work.end} - work.begin != task.duration)
      report_.add(place, "task '{}' takes {} steps, but this work goes from {} to {}", task.id,
                  task.duration, work.begin, work.end);
    const auto begun = begun_before();
    if (work.begin < 0 && !(begun && begun->first == work.task && begun->second == -work.begin))
      report_.add(place, "agent '{}' begins task '{}' at {}; expected 0 or later", agent_.id,
                  task.id, work.begin);
    if (work.end < 0) return;
    const Time first = std::max(work.begin, 0);
    if (at(first).place != task.cell)
      report_.add(place, "agent '{}' is on {} when it begins task '{}'; expected {}", agent_.id,
                  steps_.name(at(first).place), task.id, steps_.name(task.cell));
    const Time last = std::min(work.end, static_cast<Time>(poses_.size()) - 1);
    for (Time t = first + 1; t <= last; ++t)
      if (at(t) != at(first)) {
        report_.add(step_place(t), "agent '{}' leaves {} at work on task '{}'", agent_.id,
                    name(at(first)), task.id);
        return;
      }
  }

  // The task that the agent is executing at the start, and the number of steps done. Returns
  // nullopt if the agent does not start at work.
  std::optional<std::pair<TaskIndex, Time>> begun_before() const {
    if (!instance_.world().is_working(agent_.start)) return std::nullopt;
    const Work& work = instance_.world().work(agent_.start);
    return std::pair(work.task, work.done);
  }

  void check_end() {
    const Pose& end = poses_.back();
    const std::string place = step_place(poses_.size() - 1);
    if (agent_.goal && end.place != *agent_.goal)
      report_.add(place, "agent '{}' ends on {}; expected its goal {}", agent_.id,
                  steps_.name(end.place), steps_.name(*agent_.goal));
    else if (!agent_.goals.empty() && std::ranges::count(agent_.goals, end.place) == 0)
      report_.add(place, "agent '{}' ends on {}; expected one of its goals", agent_.id,
                  steps_.name(end.place));
    else if (agent_.goal_heading && (end.heading != *agent_.goal_heading || end.steps > 0))
      report_.add(place, "agent '{}' ends on {}; expected heading {}", agent_.id, name(end),
                  letter(*agent_.goal_heading));
    if (!agent_.goal && agent_.goals.empty()) check_end_without_destination(place, end);
  }

  void check_end_without_destination(const std::string& place, const Pose& end) {
    const auto is_here = [&](TaskIndex task) { return instance_.task(task).cell == end.place; };
    const std::vector<TaskIndex> visited = own_tasks();
    if (!agent_.tasks.empty() && std::ranges::none_of(visited, is_here))
      report_.add(place, "agent '{}' ends on {}; expected one of its own tasks", agent_.id,
                  steps_.name(end.place));
    if (agent_.tasks.empty() && !agent_.options.empty() && end.steps > 0)
      report_.add(place, "agent '{}' ends on {}; expected the end of the turn", agent_.id,
                  name(end));
  }

  // The tasks that the agent must visit, and those that it visits by choice.
  std::vector<TaskIndex> own_tasks() const {
    std::vector<TaskIndex> tasks = agent_.tasks;
    for (const WorkTime& work : plan_.work)
      if (std::ranges::count(tasks, work.task) == 0) tasks.push_back(work.task);
    return tasks;
  }

  // The first difference between the sequence and own_tasks().
  std::optional<std::string> wrong_task() const {
    const std::vector<TaskIndex> own = own_tasks();
    const auto with_id = [&](TaskIndex task, std::string_view what) {
      return fmt::format("task '{}' {}", instance_.task(task).id, what);
    };
    for (const TaskIndex task : plan_.sequence) {
      if (task < 0 || task >= instance_.task_count())
        return fmt::format("there is no task {}", task);
      if (std::ranges::count(plan_.sequence, task) > 1) return with_id(task, "is repeated");
      if (std::ranges::count(own, task) > 0) continue;
      const bool may_visit = std::ranges::count(agent_.options, task) > 0;
      return with_id(task, may_visit ? "has no entry in \"work\"" : "does not list the agent");
    }
    for (const TaskIndex task : own)
      if (std::ranges::count(plan_.sequence, task) == 0) return with_id(task, "is missing");
    return std::nullopt;
  }

  // Must a plan state the visits of this task?
  static bool has_stated_visits(const Task& task) {
    return task.duration > 0 || task.need < static_cast<int>(task.agents.size());
  }

  // The earliest time >= `begin` at which the agent visits the task or completes its execution.
  // Returns nullopt if there is no such time.
  std::optional<Time> visit(TaskIndex index, Time begin) const {
    const Task& task = instance_.task(index);
    if (has_stated_visits(task)) {
      const auto work = std::ranges::find(plan_.work, index, &WorkTime::task);
      if (work == plan_.work.end() || work->end < begin) return std::nullopt;
      return work->end;
    }
    const auto last = static_cast<Time>(poses_.size()) - 1;
    for (Time t = begin; t <= last; ++t)
      if (at(t).place == task.cell) return t;
    if (begin > last && poses_.back().place == task.cell) return begin;
    return std::nullopt;
  }

  void check_visits() {
    for (TaskIndex index : agent_.tasks) {
      const Task& task = instance_.task(index);
      if (!visit(index, 0))
        report_.add(place_ + (has_stated_visits(task) ? "/work" : "/path"),
                    "agent '{}' never {} its task '{}' on {}", agent_.id,
                    has_stated_visits(task) ? "does" : "visits", task.id, steps_.name(task.cell));
    }
  }

  void check_sequence() {
    const std::string place = place_ + "/sequence";
    if (const auto wrong = wrong_task()) {
      report_.add(place, "{}; expected every task of agent '{}' exactly once", *wrong, agent_.id);
      return;
    }
    // Choosing the earliest possible visit of each task is optimal, because it leaves the most time
    // for the later tasks.
    Time now = 0;
    for (std::size_t k = 0; k < plan_.sequence.size(); ++k) {
      const auto then = visit(plan_.sequence[k], now);
      if (!then) {
        report_.add(fmt::format("{}/{}", place, k),
                    "the path of agent '{}' does not visit task '{}' in this order", agent_.id,
                    instance_.task(plan_.sequence[k]).id);
        return;
      }
      now = *then;
    }
    check_last_task(place);
  }

  // Checks that an agent without a destination ends on the last task of its sequence. This does not
  // apply to an idle agent, or if the plan states one of the visits, because such a visit cannot be
  // repeated at the end.
  void check_last_task(const std::string& place) {
    const bool has_destination = agent_.goal || !agent_.goals.empty();
    const auto stated = [&](TaskIndex task) { return has_stated_visits(instance_.task(task)); };
    if (has_destination || plan_.sequence.empty() || std::ranges::any_of(plan_.sequence, stated))
      return;
    const Task& last = instance_.task(plan_.sequence.back());
    if (poses_.back().place != last.cell)
      report_.add(fmt::format("{}/{}", place, plan_.sequence.size() - 1),
                  "agent '{}' has no goal and ends on {}; expected the last task of its sequence "
                  "there, found '{}'",
                  agent_.id, steps_.name(poses_.back().place), last.id);
  }

  // The finish time: the earliest time from which the pose never changes and no task is executed.
  // If the path visits a task without duration, it does so by then, because the agent enters no
  // place later.
  Time finishes() const {
    Time time = static_cast<Time>(poses_.size()) - 1;
    while (time > 0 && at(time - 1) == poses_.back()) --time;
    for (const WorkTime& work : plan_.work) time = std::max(time, work.end);
    return time;
  }

  const Instance& instance_;
  const AllowedSteps& steps_;
  const AgentIndex index_;
  const Agent& agent_;
  const AgentPlan& plan_;
  ViolationReport& report_;
  std::string place_;
  std::vector<Pose> poses_;  // by time
};

}  // namespace

std::optional<Time> check_agent(const Instance& instance, const AllowedSteps& steps,
                                AgentIndex index, const AgentPlan& plan, ViolationReport& report) {
  return AgentCheck(instance, steps, index, plan, report).run();
}

}  // namespace grove::detail
