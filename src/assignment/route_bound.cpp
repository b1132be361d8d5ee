// SPDX-License-Identifier: MIT
// *Relaxation.* A route of agent a starts at its start, visits tasks, and ends at one of its goals
// or, if it has none, at its last task. Each plan contains such routes, whose legs cost at most the
// agents' costs: the tasks in the order in which an agent first visits them. Together they visit
// each task with a choice of agents at least `need` times, each agent visits the tasks that it must
// visit, and at most one route ends at each goal. Let there be a multiplier m >= 0 for each of
// these conditions. The reduced cost of a route is its cost, minus the multipliers of its visits,
// plus the multiplier of its goal. *Claim: the sum over the agents of the least reduced costs, plus
// the sum of need * m over the conditions on visits, minus the sum of m over the goals, is a lower
// bound on the cost of every plan.* *Proof.* For the routes of a plan the value is at most the sum
// of their costs, because each condition holds and m >= 0.
//
// *ng-routes.* The least reduced cost of an agent is computed over walks that may repeat visits. A
// label at task u remembers the visits in the neighbourhood N(u) only: on the way to v it forgets
// those outside N(v). A visit that it remembers is not repeated. Each route is such a walk, so the
// minimum is a lower bound. If there is none, because a cycle of tasks that the labels forget has a
// negative reduced cost, these multipliers give no bound. A few of the tasks that the agent must
// visit are always remembered, and a walk without them does not end; so their condition is exact
// and has no multiplier.
//
// *Legs through tasks.* Let w be a task without duration on a shortest path from u to v, for an
// agent that turns freely and may visit w. If a walk has not visited w before the leg from u to v,
// it can visit w there: this adds no cost, and a later visit of w can be left out, which adds no
// cost either. If it has visited w, but does not remember it, a second visit adds no cost. So a
// label that does not remember w need not make the leg from u to v: a walk through w costs no more.
//
// *Multipliers* are integers in units of 1 / kUnit steps, so all sums are exact. The lower bound is
// rounded up.
#include "assignment/route_bound.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "assignment/goal_choice.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kUnit = 256;  // per step
constexpr std::int64_t kNoRoute = std::numeric_limits<std::int64_t>::max() / 4;
// Tasks in a neighbourhood, with the task itself; fewer if agents times tasks exceed kMany.
constexpr int kNeighbors = 6;
constexpr int kFewNeighbors = 3;
constexpr std::int64_t kMany = 5000;
constexpr int kMaxRemembered = 10;  // tasks of an agent that labels always remember
constexpr int kMemoryBits = 13;
constexpr double kFirstFactor = 0.5;  // of the step size by Polyak
constexpr double kLastFactor = 0.005;
constexpr int kPatience = 6;       // steps without progress before the factor is halved
constexpr int kRoundsPerTest = 8;  // rounds of extensions between tests for negative cycles

// The remembered visits of a label: bit i for the i-th task that is always remembered, then one bit
// for each task of the neighbourhood.
using Memory = std::uint32_t;
constexpr std::int8_t kForgotten = -1;

}  // namespace

class RouteBound::Relaxation {
 public:
  explicit Relaxation(const Routes& routes)
      : costs_(routes.costs()), instance_(costs_.instance()), cost_(routes.cost()) {
    for (TaskIndex task = 0; task < instance_.task_count(); ++task)
      needs_.push_back(instance_.task(task).needs_all() ? 0 : instance_.task(task).need);
    places_ = all_destinations(instance_);
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) add_agent(agent);
    start_with(routes);
  }

  void improve(std::int64_t max_effort, const Limits& limits) {
    end_effort_ = effort_ + max_effort;
    while (lower_bound() < cost_ && factor_ > kLastFactor) {
      const Evaluation now = evaluate(limits);
      if (now == Evaluation::kStopped) return;
      if (now == Evaluation::kNoMinimum) {
        retreat();
        factor_ *= 0.9;
        continue;
      }
      if (bound_ > best_.bound) {
        best_ = {bound_, on_visits_, on_goals_};
        failures_ = 0;
      } else if (++failures_ == kPatience) {
        failures_ = 0;
        factor_ /= 2;
      }
      if (!step(factor_)) return;
    }
  }

  Cost lower_bound() const { return std::max<Cost>(0, (best_.bound + kUnit - 1) / kUnit); }

 private:
  enum class Evaluation : std::uint8_t { kBound, kNoMinimum, kStopped };

  // A leg from one task of an agent to another one, by position.
  struct Leg {
    std::int32_t to;
    Time steps;
    Memory needed;  // of these visits, if any, the label must remember one to make the leg
  };
  // A task of an agent.
  struct Visit {
    TaskIndex task;
    std::int32_t condition = kExact;           // index in needs_
    Time from_start = kNever;                  // kNever: no walk begins with it
    std::vector<Time> to_goals = {};           // by position in AgentData::goals
    std::vector<std::int32_t> neighbors = {};  // by bit; the task itself comes first
    std::vector<Leg> legs = {};
  };
  static constexpr std::int32_t kExact = -1;  // in place of a condition: always remembered
  struct AgentData {
    std::vector<Visit> visits;  // those that are always remembered come first
    int remembered = 0;         // their number
    int neighbor_bits = 0;
    std::vector<std::size_t> goals;  // indices in places_; empty: it ends anywhere
    std::vector<Time> start_to_goals;
  };
  struct Label {
    std::int64_t cost = kNoRoute;
    std::int32_t parent = kStart;
    std::int32_t round = -1;  // in which it was reached last
  };
  static constexpr std::int32_t kStart = -1;
  struct Best {
    std::int64_t bound = 0;
    std::vector<std::int64_t> on_visits;
    std::vector<std::int64_t> on_goals;
  };

  void add_agent(AgentIndex index) {
    const Agent& agent = instance_.agent(index);
    AgentData data;
    for (const TaskIndex task : agent.tasks) {
      const bool is_exact = std::ssize(data.visits) < kMaxRemembered;
      data.visits.push_back({task, is_exact ? kExact : static_cast<std::int32_t>(needs_.size())});
      if (is_exact)
        ++data.remembered;
      else
        needs_.push_back(1);
    }
    for (const TaskIndex task : agent.options) data.visits.push_back({task, task});
    const bool is_large = std::int64_t{instance_.agent_count()} * instance_.task_count() > kMany;
    data.neighbor_bits =
        std::min({is_large ? kFewNeighbors : kNeighbors, kMemoryBits - data.remembered,
                  static_cast<int>(data.visits.size())});
    const std::vector<Place> goals = agent.destinations();
    for (const Place goal : goals) {
      data.goals.push_back(
          static_cast<std::size_t>(std::ranges::lower_bound(places_, goal) - places_.begin()));
      data.start_to_goals.push_back(costs_.start_to_goal(index, goal));
    }
    for (Visit& visit : data.visits)
      for (const Place goal : goals)
        visit.to_goals.push_back(costs_.to_goal(index, visit.task, goal));
    add_neighbors(index, data);
    add_legs(index, data);
    agents_.push_back(std::move(data));
  }

  // The nearest tasks of each task.
  void add_neighbors(AgentIndex agent, AgentData& data) const {
    for (Visit& visit : data.visits) {
      std::vector<std::pair<Time, std::int32_t>> others;
      for (std::int32_t i = 0; i < std::ssize(data.visits); ++i) {
        const TaskIndex to = data.visits[i].task;
        others.emplace_back(to == visit.task ? -1 : costs_.between(agent, visit.task, to), i);
      }
      std::ranges::partial_sort(others, others.begin() + data.neighbor_bits);
      for (int i = 0; i < data.neighbor_bits; ++i) visit.neighbors.push_back(others[i].second);
    }
  }

  // The legs that a label may need. Those to near tasks come first.
  void add_legs(AgentIndex agent, AgentData& data) const {
    std::vector<std::int32_t> order(data.visits.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::int32_t>(i);
    const auto sort_by = [&](const auto& steps_to) {
      std::ranges::stable_sort(order, {},
                               [&](std::int32_t i) { return steps_to(data.visits[i].task); });
    };
    const auto from_start = [&](TaskIndex to) { return costs_.from_start(agent, to); };
    sort_by(from_start);
    for (const std::int32_t to : order)
      if (from_start(data.visits[to].task) < kNever &&
          visit_between(agent, data, from_start, to, order) == kNone)
        data.visits[to].from_start = from_start(data.visits[to].task);
    for (std::int32_t from = 0; from < std::ssize(data.visits); ++from) {
      const auto steps_to = [&](TaskIndex to) {
        return costs_.between(agent, data.visits[from].task, to);
      };
      sort_by(steps_to);
      for (const std::int32_t to : order) {
        const Time steps = steps_to(data.visits[to].task);
        if (to == from || steps >= kNever) continue;
        const std::int32_t between = visit_between(agent, data, steps_to, to, order);
        const Memory needed = between == kNone ? 0 : bits_of(data, from, between);
        if (between == kNone || needed != 0) data.visits[from].legs.push_back({to, steps, needed});
      }
    }
  }

  // A visit without duration on a shortest path to the visit `to`; kNone: none is known.
  // steps_to(task): the steps from the beginning of the leg. `order`: by these steps.
  template <class StepsTo>
  std::int32_t visit_between(AgentIndex agent, const AgentData& data, const StepsTo& steps_to,
                             std::int32_t to, const std::vector<std::int32_t>& order) const {
    if (instance_.agent(agent).kind > 0) return kNone;
    const TaskIndex end = data.visits[to].task;
    const Time direct = steps_to(end);
    for (const std::int32_t via : order) {
      const TaskIndex task = data.visits[via].task;
      const Time first = steps_to(task);
      if (first >= direct) break;
      // Tasks on the place where the leg begins or ends are not between the two.
      if (first > 0 && instance_.task(task).duration == 0 &&
          instance_.task(task).cell != instance_.task(end).cell &&
          first + costs_.between(agent, task, end) == direct)
        return via;
    }
    return kNone;
  }
  static constexpr std::int32_t kNone = -1;

  // The bits by which a label at the visit `at` can remember `visit`; 0: it cannot.
  static Memory bits_of(const AgentData& data, std::int32_t at, std::int32_t visit) {
    if (visit < data.remembered) return Memory{1} << visit;
    const std::vector<std::int32_t>& neighbors = data.visits[at].neighbors;
    const auto found = std::ranges::find(neighbors, visit);
    return found == neighbors.end() ? 0
                                    : Memory{1} << (data.remembered + (found - neighbors.begin()));
  }
  // What a label with `memory` at `from` remembers after the visit `to`.
  static Memory memory_after(const AgentData& data, std::int32_t from, Memory memory,
                             std::int32_t to) {
    const Memory always = (Memory{1} << data.remembered) - 1;
    Memory result = (memory & always) | bits_of(data, to, to);
    for (Memory rest = memory >> data.remembered; rest != 0; rest &= rest - 1)
      result |= bits_of(data, to, data.visits[from].neighbors[std::countr_zero(rest)]);
    return result;
  }

  // The first multipliers: what a route would cost less without the visit, and the prices of the
  // goals for the ends of the routes.
  void start_with(const Routes& routes) {
    on_visits_.assign(needs_.size(), 0);
    std::vector<bool> is_set(needs_.size(), false);
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      for (const Visit& visit : agents_[agent].visits) {
        if (visit.condition == kExact || !routes.visits(agent, visit.task)) continue;
        Routes without = routes;
        const std::int64_t saved = std::max<Cost>(0, without.remove(agent, visit.task)) * kUnit;
        std::int64_t& multiplier = on_visits_[visit.condition];
        multiplier = is_set[visit.condition] ? std::min(multiplier, saved) : saved;
        is_set[visit.condition] = true;
      }
    on_goals_.assign(places_.size(), 0);
    const auto choice = cheapest_goals(instance_, [&](AgentIndex agent, Place goal) {
      return Cost{routes.leg_to_goal(agent, goal)};
    });
    if (!choice) return;
    for (std::size_t i = 0; i < places_.size(); ++i)
      on_goals_[i] = std::min<Cost>(choice->prices[i], kNever) * kUnit;
  }

  // Computes the bound for the current multipliers, and counts the visits and the uses of goals.
  Evaluation evaluate(const Limits& limits) {
    visits_.assign(needs_.size(), 0);
    uses_.assign(places_.size(), 0);
    bound_ = 0;
    for (std::size_t i = 0; i < needs_.size(); ++i) bound_ += needs_[i] * on_visits_[i];
    for (const std::int64_t multiplier : on_goals_) bound_ -= multiplier;
    Evaluation result = Evaluation::kBound;
    for (const AgentData& agent : agents_) {
      if (effort_ >= end_effort_ || limits.stop_requested()) return Evaluation::kStopped;
      if (extend_all(agent))
        bound_ += least_reduced_cost(agent);
      else
        result = Evaluation::kNoMinimum;
    }
    return result;
  }

  // Reaches all labels of the agent. Returns false if some have no least cost, or if the effort is
  // used up.
  bool extend_all(const AgentData& agent) {
    const int bits = agent.remembered + agent.neighbor_bits;
    if (labels_.size() < agent.visits.size() << bits) labels_.resize(agent.visits.size() << bits);
    for (const std::int32_t at : reached_) labels_[at] = {};
    reached_.clear();
    std::vector<std::int32_t> now, next;
    for (std::int32_t to = 0; to < std::ssize(agent.visits); ++to)
      if (agent.visits[to].from_start < kNever)
        reach(agent, to, bits_of(agent, to, to), agent.visits[to].from_start * kUnit, kStart, 0,
              now);
    for (int round = 1; !now.empty(); ++round) {
      if (round % kRoundsPerTest == 0 && (is_on_cycle(now.back()) || effort_ >= end_effort_))
        return false;
      next.clear();
      for (const std::int32_t at : now) extend(agent, at, round, next);
      std::swap(now, next);
    }
    return true;
  }

  void extend(const AgentData& agent, std::int32_t at, int round, std::vector<std::int32_t>& next) {
    const int bits = agent.remembered + agent.neighbor_bits;
    const std::int32_t from = at >> bits;
    const Memory memory = static_cast<Memory>(at) & ((Memory{1} << bits) - 1);
    const std::int64_t cost = labels_[at].cost;
    effort_ += std::ssize(agent.visits[from].legs);
    for (const Leg& leg : agent.visits[from].legs) {
      if ((memory & bits_of(agent, from, leg.to)) != 0) continue;
      if (leg.needed != 0 && (memory & leg.needed) == 0) continue;
      reach(agent, leg.to, memory_after(agent, from, memory, leg.to), cost + leg.steps * kUnit, at,
            round, next);
    }
  }

  // Records a label with this cost before the visit, unless one that remembers no more costs no
  // more.
  void reach(const AgentData& agent, std::int32_t to, Memory memory, std::int64_t cost,
             std::int32_t parent, std::int32_t round, std::vector<std::int32_t>& next) {
    const int bits = agent.remembered + agent.neighbor_bits;
    const Visit& visit = agent.visits[to];
    if (visit.condition != kExact) cost -= on_visits_[visit.condition];
    const Memory always = (Memory{1} << agent.remembered) - 1;
    const std::int32_t at = to << bits | static_cast<std::int32_t>(memory);
    const std::int32_t forgetful =
        to << bits | static_cast<std::int32_t>((memory & always) | bits_of(agent, to, to));
    Label& label = labels_[at];
    if (label.cost <= cost || labels_[forgetful].cost <= cost) return;
    if (label.round < 0) reached_.push_back(at);
    label.cost = cost;
    label.parent = parent;
    if (label.round == round) return;
    label.round = round;
    next.push_back(at);
  }

  // True if the parents of a label form a cycle. If labels have no least cost, some do (Cherkassky
  // and Goldberg 1999).
  bool is_on_cycle(std::int32_t label) const {
    std::size_t steps = 0;
    for (; label != kStart && steps <= reached_.size(); ++steps) label = labels_[label].parent;
    return label != kStart;
  }

  std::int64_t least_reduced_cost(const AgentData& agent) {
    const int bits = agent.remembered + agent.neighbor_bits;
    const std::int32_t always = (1 << agent.remembered) - 1;
    std::pair<std::int64_t, std::size_t> best{kNoRoute, 0};
    if (agent.remembered == 0) best = cost_to_end(agent, agent.start_to_goals);
    std::int32_t last = kStart;
    for (const std::int32_t at : reached_) {
      if ((at & always) != always) continue;
      auto end = cost_to_end(agent, agent.visits[at >> bits].to_goals);
      end.first += labels_[at].cost;
      if (end.first >= best.first) continue;
      best = end;
      last = at;
    }
    count(agent, last, best.second);
    return best.first;
  }

  // The least cost to an end, and the position of the goal.
  std::pair<std::int64_t, std::size_t> cost_to_end(const AgentData& agent,
                                                   const std::vector<Time>& to_goals) const {
    std::pair<std::int64_t, std::size_t> best{agent.goals.empty() ? 0 : kNoRoute, 0};
    for (std::size_t i = 0; i < to_goals.size(); ++i) {
      if (to_goals[i] >= kNever) continue;
      const std::int64_t cost = to_goals[i] * kUnit + on_goals_[agent.goals[i]];
      if (cost < best.first) best = {cost, i};
    }
    return best;
  }

  // Counts the visits of the walk that ends with this label.
  void count(const AgentData& agent, std::int32_t last, std::size_t goal) {
    const int bits = agent.remembered + agent.neighbor_bits;
    if (!agent.goals.empty()) ++uses_[agent.goals[goal]];
    for (; last != kStart; last = labels_[last].parent) {
      const std::int32_t condition = agent.visits[last >> bits].condition;
      if (condition != kExact) ++visits_[condition];
    }
  }

  // Changes the multipliers along the subgradient, with the step size by Polyak. Returns false if
  // the subgradient is 0.
  bool step(double factor) {
    std::int64_t norm = 0;
    for (std::size_t i = 0; i < needs_.size(); ++i)
      norm += (needs_[i] - visits_[i]) * (needs_[i] - visits_[i]);
    for (const std::int64_t uses : uses_) norm += (uses - 1) * (uses - 1);
    if (norm == 0) return false;
    const double length =
        factor * static_cast<double>(cost_ * kUnit - bound_) / static_cast<double>(norm);
    const auto move = [&](std::int64_t& multiplier, std::int64_t direction) {
      multiplier += static_cast<std::int64_t>(length * static_cast<double>(direction));
      multiplier = std::max<std::int64_t>(multiplier, 0);
    };
    for (std::size_t i = 0; i < needs_.size(); ++i) move(on_visits_[i], needs_[i] - visits_[i]);
    for (std::size_t i = 0; i < places_.size(); ++i) move(on_goals_[i], uses_[i] - 1);
    return true;
  }

  // The multipliers give no bound: moves them towards the best ones, or towards 0.
  void retreat() {
    for (std::size_t i = 0; i < on_visits_.size(); ++i)
      on_visits_[i] = best_.on_visits.empty() ? on_visits_[i] * 7 / 8
                                              : (on_visits_[i] + best_.on_visits[i]) / 2;
    for (std::size_t i = 0; i < best_.on_goals.size(); ++i)
      on_goals_[i] = (on_goals_[i] + best_.on_goals[i]) / 2;
  }

  const RouteCosts& costs_;
  const Instance& instance_;
  const Cost cost_;                  // of the routes
  std::vector<std::int64_t> needs_;  // by condition: the least number of visits; first by task
  std::vector<Place> places_;        // the destinations of all agents
  std::vector<AgentData> agents_;
  std::vector<std::int64_t> on_visits_;  // multipliers by condition
  std::vector<std::int64_t> on_goals_;   // and by index in places_
  Best best_;
  double factor_ = kFirstFactor;
  int failures_ = 0;  // steps since the last progress
  std::int64_t effort_ = 0;
  std::int64_t end_effort_ = 0;
  // Of the current evaluation.
  std::int64_t bound_ = 0;
  std::vector<std::int64_t> visits_;   // by condition
  std::vector<std::int64_t> uses_;     // by index in places_
  std::vector<Label> labels_;          // of one agent, by position of the visit and memory
  std::vector<std::int32_t> reached_;  // those of labels_ with a cost
};

RouteBound::RouteBound(const Routes& routes) : relaxation_(std::make_unique<Relaxation>(routes)) {}
RouteBound::~RouteBound() = default;

void RouteBound::improve(std::int64_t max_effort, const Limits& limits) {
  relaxation_->improve(max_effort, limits);
}

Cost RouteBound::lower_bound() const {
  return relaxation_->lower_bound();
}

}  // namespace grove::detail
