// SPDX-License-Identifier: MIT
// Proof that robots that execute an action dependency graph neither collide nor wait forever.
//
// Definitions. The *row* of a place is the list of the stays of robots on this place in the plan,
// in order of time. A stay begins with the robot's move onto the place and ends with its move away.
// In a plan without vertex conflicts the stays on a place do not overlap, so the row is well
// defined.
//
// Claim 1: robots do not collide, whatever the delays. Proof: a move onto a place begins only after
// the previous robot in the row has completed its move away. By induction over the row, the stays
// on a place, each from the start of the move onto it to the end of the move away, do not overlap
// during execution either. The exception is a ring: in one joint step each robot enters the place
// that the next robot leaves. Two robots never swap places, because in a swap each robot enters the
// place that the other one leaves, so the two moves would be a ring. The plan contains no swap, so
// every ring has at least three robots.
//
// Claim 2: as long as every robot completes the actions that it has begun, the first incomplete
// step can be completed. Proof: let action x depend directly on action y. Either (a) y is an
// earlier action of the same robot, which begins earlier in the plan; or (b) x enters the place
// that y leaves. In case (b) y begins no later than x in the plan, because the robot has left the
// place when x is completed, and both moves take one time step. Hence along a cycle of dependencies
// the begin times never rise, and they fall at each dependency of type (a). Therefore all
// dependencies in a cycle are of type (b), between moves that begin in the same step of the plan.
// Each of these moves leaves one place and enters another one, and in one step at most one robot
// leaves a place and at most one enters it. Therefore the cycle is a ring of robots that follow
// each other, without branches. Because the ring is a joint step, it does not wait for itself. All
// other dependencies lead from earlier to later steps in the order computed here, so there are no
// other cycles.
//
// Transitive dependencies. Let action x depend on action a of robot i. The dependency is redundant
// if the other dependencies of x's step require, directly or indirectly, that a, a later action of
// robot i, or a move in the same ring as a is completed first. For groups of 16 robots, one pass
// over all steps in order computes, for each action, the number of actions of each robot in the
// group that must be completed before this action is completed.
#include "execution/action_dependency_graph.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "model/assert.h"
#include "model/choices.h"

namespace grove::detail {
namespace {

constexpr const char* kCollides = "a passing order requires a plan without collisions";
constexpr int kLanes = 16;
// By robot of a group: the number of its actions that are certainly completed once a given action
// is completed.
using VectorClock = std::array<std::int32_t, kLanes>;

void merge_into(VectorClock& known, const VectorClock& more) {
  for (int lane = 0; lane < kLanes; ++lane) known[lane] = std::max(known[lane], more[lane]);
}

// A robot's stay on a place, with the moves that begin and end it. kNoAction: the robot starts
// there, or rests there at the end of the plan.
struct Stay {
  Place place = kNoPlace;
  Time begin = 0;
  ActionIndex enters = kNoAction;
  ActionIndex leaves = kNoAction;
};

// True if each action is in a later step than the actions on which it depends.
bool is_ordered(const ActionDependencyGraph& order) {
  std::vector<bool> done(order.actions().size());
  const auto is_done = [&](ActionIndex a) { return a == kNoAction || done[a]; };
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    for (const ActionIndex a : order.step(number))
      if (done[a] || !is_done(order.before(a)) || !is_done(order.after(a))) return false;
    for (const ActionIndex a : order.step(number)) done[a] = true;
  }
  return true;
}

// True if `turn` is an incomplete turn that has reached state `from`.
bool continues(const Instance& instance, const Action& turn, State from) {
  return turn.kind == Action::Kind::kTurn && turn.to == from && instance.pose_of(from).steps > 0;
}

}  // namespace

ActionDependencyGraph::ActionDependencyGraph(const Instance& instance, const Plan& plan) {
  if (static_cast<int>(plan.agents.size()) != instance.agent_count())
    throw std::invalid_argument("a passing order requires a plan of all agents");
  require_no_choices(instance, "passing orders do not support", kFixedChoices);
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    add_actions(instance, agent, plan.agents[agent]);
    first_.push_back(static_cast<ActionIndex>(actions_.size()));
  }
  after_.assign(actions_.size(), kNoAction);
  find_waits(instance.world(), plan);
  order_steps();
  remove_transitive();
}

// In a path, an agent waits while it executes a task. For an execution that was in progress at the
// start, the action covers only the remaining steps.
void ActionDependencyGraph::add_actions(const Instance& instance, AgentIndex agent,
                                        const AgentPlan& plan) {
  const World& world = instance.world();
  auto work = plan.work.begin();
  const auto do_work_until = [&](Time time, State state) {
    for (; work != plan.work.end() && work->begin < time; ++work)
      if (work->end > 0)
        actions_.push_back({Action::Kind::kWork, agent, state, state, work->task,
                            std::max(work->begin, 0), work->end - std::max(work->begin, 0)});
  };
  for (Time t = 0; t + 1 < static_cast<Time>(plan.path.size()); ++t) {
    const State from = plan.path[t];
    const State to = plan.path[t + 1];
    if (from == to) continue;
    do_work_until(t, from);
    const bool is_turn = world.place(from) == world.place(to);
    if (is_turn && static_cast<ActionIndex>(actions_.size()) > first_.back() &&
        continues(instance, actions_.back(), from)) {
      actions_.back().to = to;
      ++actions_.back().steps;
    } else {
      actions_.push_back(
          {is_turn ? Action::Kind::kTurn : Action::Kind::kMove, agent, from, to, -1, t, 1});
    }
  }
  do_work_until(kNever, plan.path.back());
}

void ActionDependencyGraph::find_waits(const World& world, const Plan& plan) {
  std::vector<Stay> stays;
  for (AgentIndex agent = 0; agent < agent_count(); ++agent) {
    stays.push_back({world.place(plan.agents[agent].path.front())});
    for (ActionIndex a = begin_of(agent); a < end_of(agent); ++a) {
      if (actions_[a].kind != Action::Kind::kMove) continue;
      stays.back().leaves = a;
      stays.push_back({world.place(actions_[a].to), actions_[a].begin + 1, a});
    }
  }
  std::ranges::sort(stays, {}, [](const Stay& s) { return std::pair(s.place, s.begin); });
  for (std::size_t i = 1; i < stays.size(); ++i) {
    const Stay& before = stays[i - 1];
    const Stay& next = stays[i];
    if (before.place != next.place) continue;
    if (before.leaves == kNoAction || next.enters == kNoAction ||
        actions_[before.leaves].begin >= next.begin)
      throw std::invalid_argument(kCollides);
    if (actions_[before.leaves].agent == actions_[next.enters].agent) continue;
    GROVE_CHECK(after_[next.enters] == kNoAction, "a move waits for one other robot");
    after_[next.enters] = before.leaves;
  }
}

// Orders the steps by begin time in the plan. Among moves with the same begin time, the move that
// leaves a place precedes the move that enters it.
void ActionDependencyGraph::order_steps() {
  std::vector<ActionIndex> by_begin(actions_.size());
  std::iota(by_begin.begin(), by_begin.end(), 0);
  std::ranges::stable_sort(by_begin, {}, [&](ActionIndex a) { return actions_[a].begin; });
  std::vector<bool> done(actions_.size());
  std::vector<ActionIndex> row;
  for (const ActionIndex first : by_begin) {
    row.clear();
    for (ActionIndex a = first; a != kNoAction && !done[a]; a = after_[a]) {
      if (actions_[a].begin < actions_[first].begin) break;
      done[a] = true;
      row.push_back(a);
    }
    if (!row.empty() && after_[row.back()] == row.front()) {
      if (row.size() < 3) throw std::invalid_argument(kCollides);
      for (const ActionIndex a : row) steps_.add(a);
      for (const ActionIndex a : row) after_[a] = kNoAction;
      steps_.end_row();
      ++rings_;
      continue;
    }
    for (auto a = row.rbegin(); a != row.rend(); ++a) {
      steps_.add(*a);
      steps_.end_row();
    }
  }
  GROVE_CHECK(steps_.items().size() == actions_.size(), "each action is in one step");
  GROVE_ASSERT(is_ordered(*this), "a step comes after the steps on which it depends");
}

void ActionDependencyGraph::remove_transitive() {
  std::vector<VectorClock> known(actions_.size());
  std::vector<bool> is_transitive(actions_.size());
  for (AgentIndex group = 0; group < agent_count(); group += kLanes) {
    const auto lane_of = [&](ActionIndex a) { return actions_[a].agent - group; };
    const auto is_in_group = [&](ActionIndex a) { return lane_of(a) >= 0 && lane_of(a) < kLanes; };
    for (std::int32_t number = 0; number < step_count(); ++number) {
      VectorClock now{};
      for (const ActionIndex a : step(number)) {
        if (before(a) != kNoAction) merge_into(now, known[before(a)]);
        const ActionIndex other = after_[a];
        if (other == kNoAction) continue;
        if (is_in_group(other) && now[lane_of(other)] > other - begin_of(actions_[other].agent))
          is_transitive[a] = true;
        merge_into(now, known[other]);
      }
      for (const ActionIndex a : step(number))
        if (is_in_group(a)) now[lane_of(a)] = a - begin_of(actions_[a].agent) + 1;
      for (const ActionIndex a : step(number)) known[a] = now;
    }
  }
  for (ActionIndex a = 0; a < static_cast<ActionIndex>(actions_.size()); ++a) {
    if (after_[a] == kNoAction) continue;
    ++(is_transitive[a] ? removed_dependency_count_ : dependency_count_);
    if (is_transitive[a]) after_[a] = kNoAction;
  }
}

namespace {

// An agent's tasks without duration that are not visited yet, by place.
using Open = std::multimap<Place, TaskIndex>;

std::vector<Open> open_tasks(const Instance& instance) {
  std::vector<Open> open(instance.agent_count());
  for (TaskIndex t = 0; t < instance.task_count(); ++t) {
    const Task& task = instance.task(t);
    if (task.duration > 0) continue;
    for (const AgentIndex agent : task.agents) open[agent].emplace(task.cell, t);
  }
  return open;
}

void visit_place(Place place, ActionIndex action, Open& open, std::vector<TaskVisit>& visits) {
  const auto [begin, end] = open.equal_range(place);
  for (auto task = begin; task != end; ++task) visits.push_back({task->second, action});
  open.erase(begin, end);
}

}  // namespace

std::vector<std::vector<TaskVisit>> task_visits(const Instance& instance,
                                                const ActionDependencyGraph& order) {
  const World& world = instance.world();
  std::vector<Open> open = open_tasks(instance);
  std::vector<std::vector<TaskVisit>> visits(instance.agent_count());
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    visit_place(world.place(instance.agent(agent).start), kNoAction, open[agent], visits[agent]);
    for (ActionIndex a = order.begin_of(agent); a < order.end_of(agent); ++a) {
      const Action& action = order.actions()[a];
      if (action.kind == Action::Kind::kWork) visits[agent].push_back({action.task, a});
      visit_place(world.place(action.to), a, open[agent], visits[agent]);
    }
    GROVE_CHECK(std::ranges::is_sorted(visits[agent], {}, &TaskVisit::action),
                "an agent's visits are in order of its actions");
  }
  return visits;
}

}  // namespace grove::detail
