// SPDX-License-Identifier: MIT
// *Legs through tasks.* Let w be a task without duration on a shortest path from u to v, for an
// agent that turns freely and may or must visit w. A label at u that does not remember w need not
// make the leg from u to v, if it can go to w instead. *Claim: the least reduced cost of a label at
// an end is still at most that of each route.* (Prizes are not negative.) *Proof.* By induction
// there is always a label L and a rest S of the route, a sequence of different stops, such that L
// remembers no stop of S, the stops that must always be remembered are in L or S, and the cost of L
// plus that of S is at most the cost of the route. At first L is empty and S is the route. Let v be
// the first stop of S. If L makes the leg to v, extend L by v. If it does not because of w, extend
// L by w and remove w from S: the way to v is no longer, a visit of w later on is left out, which
// adds no cost by the triangle inequality, and the prize of w is not negative. This ends, because w
// is nearer to v. If L was dropped for another label, the latter remembers no more, has the same
// stops that are always remembered, and costs no more.
#include "assignment/agent_walks.h"

#include <algorithm>
#include <utility>

namespace grove::detail {
namespace {

constexpr int kMaxRemembered = 10;
constexpr std::int32_t kNone = -1;

// Adds the legs of one agent.
class LegBuilder {
 public:
  LegBuilder(const RouteCosts& costs, AgentWalks& walks)
      : costs_(costs), instance_(costs.instance()), walks_(walks), order_(walks.tasks.size()) {
    for (std::int32_t i = 0; i < std::ssize(order_); ++i) order_[i] = i;
  }

  void add_from_start() {
    const auto steps_to = [&](TaskIndex to) { return costs_.from_start(walks_.agent, to); };
    for_each_leg(steps_to, [&](std::int32_t to, Time steps, std::int32_t through) {
      if (through == kNone) walks_.forward.stops[to].first = steps * AgentWalks::kUnit;
    });
  }

  void add_from(std::int32_t from) {
    walks_.forward.stops[from].legs.clear();
    const auto steps_to = [&](TaskIndex to) {
      return costs_.between(walks_.agent, walks_.tasks[from], to);
    };
    for_each_leg(steps_to, [&](std::int32_t to, Time steps, std::int32_t through) {
      if (to == from) return;
      const NgStops::Memory needed = through == kNone ? 0 : walks_.forward.bits_of(from, through);
      if (through == kNone || needed != 0)
        walks_.forward.stops[from].legs.push_back({to, steps * AgentWalks::kUnit, needed});
    });
  }

 private:
  // Calls add(stop, steps, a stop on the way or kNone), for each stop, the nearest first.
  template <class StepsTo, class Add>
  void for_each_leg(const StepsTo& steps_to, Add add) {
    std::ranges::stable_sort(order_, {},
                             [&](std::int32_t stop) { return steps_to(walks_.tasks[stop]); });
    for (const std::int32_t to : order_) {
      const Time steps = steps_to(walks_.tasks[to]);
      if (steps < kNever) add(to, steps, stop_between(steps_to, to));
    }
  }

  // A stop without duration on a shortest path to `to`.
  template <class StepsTo>
  std::int32_t stop_between(const StepsTo& steps_to, std::int32_t to) const {
    if (instance_.agent(walks_.agent).kind > 0) return kNone;
    const TaskIndex end = walks_.tasks[to];
    const Time direct = steps_to(end);
    for (const std::int32_t stop : order_) {
      const TaskIndex task = walks_.tasks[stop];
      const Time first = steps_to(task);
      if (first >= direct) break;
      // Tasks on the place where the leg begins or ends are not between the two.
      if (first > 0 && instance_.task(task).duration == 0 &&
          instance_.task(task).cell != instance_.task(end).cell &&
          first + costs_.between(walks_.agent, task, end) == direct)
        return stop;
    }
    return kNone;
  }

  const RouteCosts& costs_;
  const Instance& instance_;
  AgentWalks& walks_;
  std::vector<std::int32_t> order_;  // all stops
};

void add_neighbors(const RouteCosts& costs, AgentWalks& walks, int count) {
  for (std::size_t stop = 0; stop < walks.tasks.size(); ++stop) {
    std::vector<std::pair<Time, std::int32_t>> others;
    for (std::size_t other = 0; other < walks.tasks.size(); ++other)
      others.emplace_back(
          other == stop ? -1 : costs.between(walks.agent, walks.tasks[stop], walks.tasks[other]),
          static_cast<std::int32_t>(other));
    std::ranges::partial_sort(others, others.begin() + count);
    for (int i = 0; i < count; ++i)
      walks.forward.add_neighbor(static_cast<std::int32_t>(stop), others[i].second);
  }
}

}  // namespace

AgentWalks make_agent_walks(const RouteCosts& costs, AgentIndex index,
                            std::pair<int, int> neighbors) {
  const Agent& agent = costs.instance().agent(index);
  AgentWalks walks{.agent = index,
                   .tasks = agent.tasks,
                   .forward = {},
                   .goals = {},
                   .start_to_goals = {},
                   .to_goals = {}};
  walks.tasks.insert(walks.tasks.end(), agent.options.begin(), agent.options.end());
  walks.forward.stops.resize(walks.tasks.size());
  walks.forward.remembered = std::min(kMaxRemembered, static_cast<int>(agent.tasks.size()));
  walks.forward.neighbors =
      std::min({neighbors.second, NgStops::kMaxBits - walks.forward.remembered,
                static_cast<int>(walks.tasks.size())});
  walks.goals = agent.destinations();
  for (const Place goal : walks.goals)
    walks.start_to_goals.push_back(costs.start_to_goal(index, goal));
  for (const TaskIndex task : walks.tasks) {
    walks.to_goals.emplace_back();
    for (const Place goal : walks.goals)
      walks.to_goals.back().push_back(costs.to_goal(index, task, goal));
  }
  add_neighbors(costs, walks, std::min(neighbors.first, walks.forward.neighbors));
  LegBuilder legs(costs, walks);
  legs.add_from_start();
  for (std::int32_t from = 0; from < std::ssize(walks.tasks); ++from) legs.add_from(from);
  return walks;
}

bool AgentWalks::forbid_cycle(const RouteCosts& costs, const std::vector<std::int32_t>& cycle) {
  const std::vector<std::int32_t> changed = forward.forbid_cycle(cycle);
  if (!has_all_legs) return !changed.empty();
  LegBuilder legs(costs, *this);
  for (const std::int32_t from : changed) legs.add_from(from);  // which legs are needed changes
  return !changed.empty();
}

void AgentWalks::keep_legs(
    const RouteCosts& costs,
    const std::function<bool(std::int32_t, std::int32_t, std::int64_t)>& keep) {
  for (std::int32_t stop = 0; stop < std::ssize(tasks); ++stop) {
    std::vector<NgStops::Leg> legs = legs_from(costs, stop);
    std::erase_if(legs, [&](const NgStops::Leg& leg) { return !keep(stop, leg.to, leg.cost); });
    forward.stops[stop].legs = std::move(legs);
    if (has_all_legs) {
      const Time steps = costs.from_start(agent, tasks[stop]);
      forward.stops[stop].first = steps < kNever ? steps * kUnit : NgStops::kNoWalk;
    }
    std::int64_t& first = forward.stops[stop].first;
    if (first < NgStops::kNoWalk && !keep(-1, stop, first)) first = NgStops::kNoWalk;
  }
  has_all_legs = false;
}

// All legs before keep_legs(), then those that are left.
std::vector<NgStops::Leg> AgentWalks::legs_from(const RouteCosts& costs, std::int32_t from) const {
  if (!has_all_legs) return forward.stops[from].legs;
  std::vector<NgStops::Leg> legs;
  for (std::int32_t to = 0; to < std::ssize(tasks); ++to) {
    const Time steps = costs.between(agent, tasks[from], tasks[to]);
    if (from != to && steps < kNever) legs.push_back({to, steps * kUnit, 0});
  }
  std::ranges::stable_sort(legs, {}, &NgStops::Leg::cost);
  return legs;
}

std::size_t AgentWalks::bytes() const {
  std::size_t bytes = tasks.size() * (tasks.size() + goals.size() * sizeof(Time));
  for (const NgStops::Stop& stop : forward.stops) bytes += stop.legs.size() * sizeof(NgStops::Leg);
  return bytes;
}

void AgentWalks::exclude(std::int32_t excluded) {
  for (NgStops::Stop& stop : forward.stops)
    std::erase_if(stop.legs, [&](const NgStops::Leg& leg) { return leg.to == excluded; });
  forward.stops[excluded].legs.clear();
  forward.stops[excluded].first = NgStops::kNoWalk;
}

void AgentWalks::exclude_goal(Place goal) {
  const auto position = std::ranges::find(goals, goal) - goals.begin();
  start_to_goals[position] = kNever;
  for (std::vector<Time>& to_goal : to_goals) to_goal[position] = kNever;
}

NgStops AgentWalks::reversed(const RouteCosts& costs,
                             const std::vector<std::int64_t>& first_costs) const {
  NgStops reverse = forward;
  for (std::size_t stop = 0; stop < tasks.size(); ++stop) {
    reverse.stops[stop].first = first_costs[stop];
    reverse.stops[stop].legs.clear();
  }
  for (std::int32_t from = 0; from < std::ssize(tasks); ++from)
    for (const NgStops::Leg& leg : legs_from(costs, from))
      reverse.stops[leg.to].legs.push_back({from, leg.cost, 0});
  return reverse;
}

}  // namespace grove::detail
