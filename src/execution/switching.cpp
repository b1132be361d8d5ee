// SPDX-License-Identifier: MIT
// Proof that switches cause neither collisions nor deadlocks.
//
// The *row* of a place is the list of robots that will be on it, in order. A move onto a place
// begins only after the previous robot in the row has completed its move away. Therefore robots
// never collide, whatever the rows are (proof: action_dependency_graph.cpp). However, with
// arbitrary rows robots could wait in a cycle.
//
// A switch moves a robot behind another one in the rows of a group of places. It requires that the
// robot has not begun to enter any of these places. The switch is made only if afterwards all
// incomplete actions have a topological order, which is computed by repeatedly removing an action
// that waits for no remaining action. Hence there is no cycle, and as long as robots complete the
// actions that they have begun, the first incomplete action in that order can be completed. A
// switch does not affect actions that have begun: actions that wait for them remain behind them in
// the rows.
//
// The joint step of a ring counts as one action, and waits within the ring are ignored. If a switch
// put another robot between two robots of a ring, the ring would wait for itself through that
// robot. Then there would be no topological order, so the switch is not made.
#include "execution/switching.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <vector>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr Time kMaxPatienceFactor =
    64;  // maximum wait between attempts, in multiples of `patience`, if no action is in progress

// A robot's stay on a place.
struct Visit {
  AgentIndex agent = -1;
  ActionIndex enters = kNoAction;  // kNoAction: the robot starts there
  ActionIndex leaves = kNoAction;  // kNoAction: the robot rests there at the end
};

// The rows of all places, and the resulting dependencies.
class PlaceRows {
 public:
  PlaceRows(const World& world, const Plan& plan, const ActionDependencyGraph& order)
      : order_(order),
        by_agent_(static_cast<std::size_t>(order.agent_count())),
        number_(order.actions().size(), -1),
        rows_(static_cast<std::size_t>(world.place_count())) {
    for (AgentIndex agent = 0; agent < order.agent_count(); ++agent)
      add_visits(world, agent, plan.agents[agent].path.front());
    for (auto& row : rows_)
      std::ranges::sort(row, {}, [&](int visit) { return begin_of(visits_[visit]); });
    for (const auto& row : rows_)
      for (std::size_t i = 0; i < row.size(); ++i) position_[row[i]] = static_cast<int>(i);
  }

  // The action that must be completed before `action` may enter its place; kNoAction if there is
  // none.
  ActionIndex after(ActionIndex action) const {
    const int visit = number_[action];
    if (visit < 0 || position_[visit] == 0) return kNoAction;
    const Visit& before = visits_[rows_[place_[visit]][position_[visit] - 1]];
    return before.agent == visits_[visit].agent ? kNoAction : before.leaves;
  }

  // Returns the visits to the contested places: the place that `entering` enters, and the places
  // around it that both robots visit consecutively, in the same or in opposite directions. Each
  // pair is (visit by `other`, visit by the robot of `entering`) to one place. Places that `other`
  // does not pass first are omitted. Returns no pairs if `other` does not pass the place first.
  std::vector<std::pair<int, int>> group(ActionIndex entering, AgentIndex other) const {
    const int mine = number_[entering];
    const auto& row = rows_[place_[mine]];
    int theirs = -1;
    for (int i = position_[mine] - 1; i >= 0 && theirs < 0; --i)
      if (visits_[row[i]].agent == other) theirs = row[i];
    if (theirs < 0) return {};
    std::vector<std::pair<int, int>> pairs{{theirs, mine}};
    for (const int direction : {1, -1})
      for (const int step : {1, -1})
        for (int k = 1;
             is_shared(theirs + direction * step * k, other, mine + step * k, visits_[mine].agent);
             ++k)
          pairs.emplace_back(theirs + direction * step * k, mine + step * k);
    std::erase_if(pairs, [&](const auto& p) { return position_[p.first] > position_[p.second]; });
    return pairs;
  }

  const Visit& visit(int number) const { return visits_[number]; }

  // Moves `visit` directly behind `other` in the row of their place. To undo this, call move() with
  // the earlier position.
  void move_behind(int visit, int other) {
    GROVE_ASSERT(place_[visit] == place_[other], "a visit stays in the row of its place");
    move(visit, position_[other]);
  }
  int position(int visit) const { return position_[visit]; }
  void move(int visit, int to) {
    auto& row = rows_[place_[visit]];
    const int from = position_[visit];
    const auto at = [&](int i) { return row.begin() + i; };
    if (from < to)
      std::rotate(at(from), at(from) + 1, at(to) + 1);
    else
      std::rotate(at(to), at(from), at(from) + 1);
    for (int i = std::min(from, to); i <= std::max(from, to); ++i) position_[row[i]] = i;
    GROVE_ASSERT(row[to] == visit && position_[visit] == to, "a visit is at its position");
  }

 private:
  void add_visits(const World& world, AgentIndex agent, State start) {
    by_agent_[agent].first = static_cast<int>(visits_.size());
    add({agent}, world.place(start));
    for (ActionIndex a = order_.begin_of(agent); a < order_.end_of(agent); ++a) {
      if (order_.actions()[a].kind != Action::Kind::kMove) continue;
      visits_.back().leaves = a;
      number_[a] = static_cast<int>(visits_.size());
      add({agent, a}, world.place(order_.actions()[a].to));
    }
    by_agent_[agent].second = static_cast<int>(visits_.size());
  }
  void add(const Visit& visit, Place place) {
    rows_[place].push_back(static_cast<int>(visits_.size()));
    visits_.push_back(visit);
    place_.push_back(place);
    position_.push_back(0);
  }
  Time begin_of(const Visit& visit) const {
    return visit.enters == kNoAction ? -1 : order_.actions()[visit.enters].begin;
  }
  bool is_shared(int theirs, AgentIndex other, int mine, AgentIndex self) const {
    const auto is_of = [&](int visit, AgentIndex agent) {
      return visit >= by_agent_[agent].first && visit < by_agent_[agent].second;
    };
    return is_of(theirs, other) && is_of(mine, self) && place_[theirs] == place_[mine];
  }

  const ActionDependencyGraph& order_;
  std::vector<std::pair<int, int>> by_agent_;  // range of the agent's visits, in order of time
  std::vector<int> number_;                    // by action: the visit that it begins; -1: none
  std::vector<Visit> visits_;
  std::vector<Place> place_;            // by visit
  std::vector<int> position_;           // by visit: position in its row
  std::vector<std::vector<int>> rows_;  // by place
};

class Switching {
 public:
  Switching(const World& world, const Plan& plan, const ActionDependencyGraph& order,
            const Duration& duration, Time patience)
      : order_(order),
        duration_(duration),
        patience_(patience),
        rows_(world, plan, order),
        step_of_(order.actions().size()),
        waits_(static_cast<std::size_t>(order.agent_count())),
        next_(static_cast<std::size_t>(order.agent_count())) {
    result_.trace.begin.assign(order.actions().size(), kNever);
    result_.trace.end.assign(order.actions().size(), kNever);
    for (std::int32_t step = 0; step < order.step_count(); ++step)
      for (const ActionIndex a : order.step(step)) step_of_[a] = step;
    for (AgentIndex agent = 0; agent < order.agent_count(); ++agent)
      next_[agent] = order.begin_of(agent);
  }

  SwitchableTrace run() {
    event_times_.push(0);
    while (!event_times_.empty()) {
      GROVE_CHECK(event_times_.top() >= now_, "events are in order of time");
      now_ = event_times_.top();
      while (!event_times_.empty() && event_times_.top() == now_) event_times_.pop();
      begin_enabled();
      for (AgentIndex agent = 0; agent < order_.agent_count(); ++agent) consider(agent);
    }
    for (AgentIndex agent = 0; agent < order_.agent_count(); ++agent)
      if (next_[agent] < order_.end_of(agent))
        result_.blocked_robots.push_back({agent, waits_for(next_[agent])});
    return std::move(result_);
  }

 private:
  // A robot's wait: the action that waits, the time between attempts, and the time of the next
  // attempt.
  struct Wait {
    ActionIndex action = kNoAction;
    Time patience = 0;
    Time until = 0;
  };

  bool is_done(ActionIndex a) const { return result_.trace.end[a] <= now_; }
  bool is_begun(ActionIndex a) const { return result_.trace.begin[a] <= now_; }
  bool is_in_ring(ActionIndex a) const { return order_.step(step_of_[a]).size() > 1; }

  // The action of another robot that must be completed before `a` begins; kNoAction if there is
  // none, or if both actions belong to one ring.
  ActionIndex after(ActionIndex a) const {
    const ActionIndex other = rows_.after(a);
    return other != kNoAction && step_of_[other] == step_of_[a] ? kNoAction : other;
  }
  bool may_begin_alone(ActionIndex a) const {
    const ActionIndex other = after(a);
    const ActionIndex before = order_.before(a);
    return (before == kNoAction || is_done(before)) && (other == kNoAction || is_done(other));
  }

  void begin_enabled() {
    for (AgentIndex agent = 0; agent < order_.agent_count(); ++agent) {
      ActionIndex& next = next_[agent];
      if (next < order_.end_of(agent) && is_begun(next) && is_done(next)) ++next;
    }
    for (AgentIndex agent = 0; agent < order_.agent_count(); ++agent) {
      const ActionIndex a = next_[agent];
      if (a == order_.end_of(agent) || is_begun(a)) continue;
      const auto step = order_.step(step_of_[a]);
      if (std::ranges::all_of(step, [&](ActionIndex m) { return may_begin_alone(m); })) begin(step);
    }
  }

  void begin(std::span<const ActionIndex> step) {
    Time end = now_;
    for (const ActionIndex a : step) {
      end = std::max(end, end_of_action(now_, duration_(a, now_)));
    }
    for (const ActionIndex a : step) {
      GROVE_CHECK(result_.trace.begin[a] == kNever, "an action begins once");
      result_.trace.begin[a] = now_;
      result_.trace.end[a] = end;
    }
    if (end < kNever) event_times_.push(end);
  }

  // Attempts a switch if the robot has waited long enough for another robot.
  void consider(AgentIndex agent) {
    const ActionIndex a = next_[agent];
    if (a == order_.end_of(agent) || is_begun(a) || is_in_ring(a)) return;
    const ActionIndex other = after(a);
    if (other == kNoAction || is_done(other)) return;
    Wait& wait = waits_[agent];
    if (wait.action != a) {
      wait = {a, patience_, now_ + patience_};
      event_times_.push(wait.until);
      return;
    }
    if (now_ < wait.until) return;
    if (try_switch(a, order_.actions()[other].agent)) {
      event_times_.push(now_);  // because the action may now begin
      wait = {};
      return;
    }
    if (wait.patience >= kMaxPatienceFactor * patience_ && !has_action_in_progress()) return;
    wait.patience *= 2;
    wait.until = now_ + wait.patience;
    event_times_.push(wait.until);
  }

  // The robot for which this action waits; the action's own robot if the action has begun.
  AgentIndex waits_for(ActionIndex action) const {
    for (const ActionIndex a : order_.step(step_of_[action])) {
      const AgentIndex agent = order_.actions()[a].agent;
      const ActionIndex other = after(a);
      if (other != kNoAction && !is_done(other)) return order_.actions()[other].agent;
      if (next_[agent] != a) return agent;  // has not reached the ring yet
    }
    return order_.actions()[action].agent;
  }

  bool has_action_in_progress() const {
    for (AgentIndex agent = 0; agent < order_.agent_count(); ++agent) {
      const ActionIndex a = next_[agent];
      if (a < order_.end_of(agent) && is_begun(a) && result_.trace.end[a] < kNever) return true;
    }
    return false;
  }

  bool try_switch(ActionIndex entering, AgentIndex other) {
    const auto group = rows_.group(entering, other);
    for (const auto& [theirs, mine] : group) {
      const Visit& visit = rows_.visit(theirs);
      const bool may_yield = visit.enters != kNoAction && !is_begun(visit.enters) &&
                             rows_.visit(mine).leaves != kNoAction;
      if (!may_yield) return false;
    }
    if (group.empty()) return false;
    const Cost before = expected();
    GROVE_CHECK(before < kInfiniteCost, "robots never wait in a cycle");
    std::vector<std::pair<int, int>> undo;
    for (const auto& [theirs, mine] : group) {
      undo.emplace_back(theirs, rows_.position(theirs));
      rows_.move_behind(theirs, mine);
    }
    if (expected() < before) {
      result_.switches += std::ssize(group);
      return true;
    }
    for (auto u = undo.rbegin(); u != undo.rend(); ++u) rows_.move(u->first, u->second);
    GROVE_ASSERT(expected() == before, "a switch that is undone has no effect");
    return false;
  }

  // The expected completion time of an action that begins, or has begun, at `begin`.
  Time expected_end(ActionIndex a, Time begin) const {
    const Time end = begin + order_.actions()[a].steps;
    return end > now_ || !is_begun(a) ? end : now_ + std::max(1, now_ - end);
  }

  // The expected sum of finish times; kInfiniteCost if robots would wait in a cycle.
  Cost expected() {
    const auto count = order_.actions().size();
    ends_.assign(static_cast<std::size_t>(order_.step_count()), kNever);
    left_.assign(static_cast<std::size_t>(order_.step_count()), 0);
    waiting_.assign(count, kNoAction);
    queue_.clear();
    followers_.assign(count, kNoAction);
    for (ActionIndex a = 0; a < static_cast<ActionIndex>(count); ++a) {
      const auto step = step_of_[a];
      if (is_done(a)) {
        ends_[step] = result_.trace.end[a];
        continue;
      }
      if (is_begun(a)) continue;
      if (const ActionIndex before = order_.before(a); before != kNoAction && !is_done(before))
        ++left_[step];
      if (const ActionIndex other = after(a); other != kNoAction && !is_done(other)) {
        ++left_[step];
        waiting_[a] = followers_[other];
        followers_[other] = a;
      }
    }
    for (std::int32_t step = 0; step < order_.step_count(); ++step)
      if (left_[step] == 0 && !is_done(order_.step(step).front())) queue_.push_back(step);
    std::size_t taken = 0;
    for (; taken < queue_.size(); ++taken) take(queue_[taken]);
    for (std::int32_t step = 0; step < order_.step_count(); ++step)
      if (ends_[step] == kNever) return kInfiniteCost;
    Cost sum = 0;
    for (AgentIndex agent = 0; agent < order_.agent_count(); ++agent)
      if (order_.begin_of(agent) < order_.end_of(agent))
        sum += ends_[step_of_[order_.end_of(agent) - 1]];
    return sum;
  }

  void take(std::int32_t step) {
    Time begin = now_;
    for (const ActionIndex a : order_.step(step)) {
      if (is_begun(a)) begin = result_.trace.begin[a];
      if (is_begun(a)) continue;
      if (const ActionIndex before = order_.before(a); before != kNoAction)
        begin = std::max(begin, ends_[step_of_[before]]);
      if (const ActionIndex other = after(a); other != kNoAction)
        begin = std::max(begin, ends_[step_of_[other]]);
    }
    Time end = 0;
    for (const ActionIndex a : order_.step(step)) end = std::max(end, expected_end(a, begin));
    ends_[step] = end;
    for (const ActionIndex a : order_.step(step)) {
      if (a + 1 < order_.end_of(order_.actions()[a].agent)) release(a + 1);
      for (ActionIndex w = followers_[a]; w != kNoAction; w = waiting_[w]) release(w);
    }
  }
  void release(ActionIndex a) {
    GROVE_ASSERT(left_[step_of_[a]] > 0, "a step waits for each action that releases it");
    if (--left_[step_of_[a]] == 0) queue_.push_back(step_of_[a]);
  }

  const ActionDependencyGraph& order_;
  const Duration& duration_;
  const Time patience_;
  PlaceRows rows_;
  std::vector<std::int32_t> step_of_;  // by action
  std::vector<Wait> waits_;            // by agent
  std::vector<ActionIndex> next_;      // by agent: its first incomplete action
  std::priority_queue<Time, std::vector<Time>, std::greater<>> event_times_;
  Time now_ = 0;
  SwitchableTrace result_;

  // Workspace of expected().
  std::vector<Time> ends_;          // by step
  std::vector<std::int32_t> left_;  // by step: number of incomplete actions that it waits for
  std::vector<ActionIndex>
      followers_;  // by action: head of the list of actions that wait for its place
  std::vector<ActionIndex> waiting_;  // by action: next action in such a list
  std::vector<std::int32_t> queue_;
};

}  // namespace

SwitchableTrace simulate_switchable(const World& world, const Plan& plan,
                                    const ActionDependencyGraph& order, const Duration& duration,
                                    Time patience) {
  return Switching(world, plan, order, duration, patience).run();
}

}  // namespace grove::detail
