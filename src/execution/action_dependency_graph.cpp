// SPDX-License-Identifier: MIT
// Why robots that keep to the order never collide. Of a place the plan makes a row: the robots that
// are on it, one after the other, each from its move onto it to its move away. In a plan without
// vertex conflicts these stays do not overlap, so the row is well defined. An action that enters a
// place waits until the robot before it in the row has completed its move away; that one waited for
// the one before, and so on. So stays, counted from the begin of the move onto the place to the end
// of the move away, do not overlap either, whatever the delays. Within a ring they touch: there
// each robot enters, in a step that all make together, the place that the next one leaves. Two
// robots never swap places: in a swap each would have to enter a place that the other leaves in the
// same step, which the plan excludes; a ring has three robots or more.
//
// Why nobody waits for ever. Let an action wait for another directly: it is a later one of the same
// robot, which begins later in the plan; or it enters a place that the other leaves, and then the
// other begins no later in the plan, for the place is empty before it is entered, at the end of a
// move. Round a circle of waits the times of begin would never rise and, where a robot's own
// actions follow each other, fall: so all waits in it are of the second kind, between moves that
// begin in the same step. Each move enters one place and leaves one, which one robot at most leaves
// or enters in that step: the circle is a ring of robots that follow each other, without branches,
// and as a joint step it waits for nothing of its own. All other waits lead from earlier steps to
// later ones in the order made here, which is therefore without circles. So as long as every robot
// completes what it has begun, the first step that is not completed can be.
//
// What is transitive. Let `x` name `a`, which is of robot i. If x's robot has, before x, waited for
// a or for something that i does later, directly or by others, or for a move of a's ring, which is
// completed with it, then a is completed when x may begin: the wait says nothing more. For 16
// robots at a time one pass over all steps, in order, finds the last action of each that must be
// completed before each action can be.
#include "execution/action_dependency_graph.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace grove::detail {
namespace {

constexpr const char* kCollides = "a passing order is of a plan without collisions";
constexpr int kLanes = 16;
// By robot of a group: how many of its actions are completed when something is.
using Known = std::array<std::int32_t, kLanes>;

void learn(Known& known, const Known& more) {
  for (int lane = 0; lane < kLanes; ++lane) known[lane] = std::max(known[lane], more[lane]);
}

// A robot's being on a place, with the moves by which it came and goes; none at start and end.
struct Stay {
  Place place = kNoPlace;
  Time begin = 0;
  ActionIndex enters = kNoAction;
  ActionIndex leaves = kNoAction;
};

// Is this step of a turn the next of the same turn?
bool goes_on(const Instance& instance, const Action& turn, State from) {
  return turn.kind == Action::Kind::kTurn && turn.to == from && instance.pose_of(from).steps > 0;
}

}  // namespace

ActionDependencyGraph::ActionDependencyGraph(const Instance& instance, const Plan& plan) {
  if (static_cast<int>(plan.agents.size()) != instance.agent_count())
    throw std::invalid_argument("a passing order is of a plan of all agents");
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    add_actions(instance, agent, plan.agents[agent]);
    first_.push_back(static_cast<ActionIndex>(actions_.size()));
  }
  after_.assign(actions_.size(), kNoAction);
  find_waits(instance.world(), plan);
  order_steps();
  leave_out_transitive();
}

// Work is done where the path stands still; what is left of it if it was begun before the start.
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
        goes_on(instance, actions_.back(), from)) {
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
    if (actions_[before.leaves].agent != actions_[next.enters].agent)
      after_[next.enters] = before.leaves;
  }
}

// By their begin in the plan, and in a step of the plan whoever leaves a place first.
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
}

void ActionDependencyGraph::leave_out_transitive() {
  std::vector<Known> known(actions_.size());
  std::vector<bool> is_transitive(actions_.size());
  for (AgentIndex group = 0; group < agent_count(); group += kLanes) {
    const auto lane_of = [&](ActionIndex a) { return actions_[a].agent - group; };
    const auto is_in_group = [&](ActionIndex a) { return lane_of(a) >= 0 && lane_of(a) < kLanes; };
    for (std::int32_t number = 0; number < step_count(); ++number) {
      Known now{};
      for (const ActionIndex a : step(number)) {
        if (before(a) != kNoAction) learn(now, known[before(a)]);
        const ActionIndex other = after_[a];
        if (other == kNoAction) continue;
        if (is_in_group(other) && now[lane_of(other)] > other - begin_of(actions_[other].agent))
          is_transitive[a] = true;
        learn(now, known[other]);
      }
      for (const ActionIndex a : step(number))
        if (is_in_group(a)) now[lane_of(a)] = a - begin_of(actions_[a].agent) + 1;
      for (const ActionIndex a : step(number)) known[a] = now;
    }
  }
  for (ActionIndex a = 0; a < static_cast<ActionIndex>(actions_.size()); ++a) {
    if (after_[a] == kNoAction) continue;
    ++(is_transitive[a] ? transitive_waits_ : waits_);
    if (is_transitive[a]) after_[a] = kNoAction;
  }
}

}  // namespace grove::detail
