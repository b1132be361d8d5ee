// SPDX-License-Identifier: MIT
// Slack induction by string removals (Christiaens and Vanden Berghe 2020). An iteration chooses a
// random visit and removes strings of successive visits from the routes of the nearest tasks, one
// string per route. Then it inserts the visits again one by one, each at its cheapest position: an
// optional visit in the routes of all agents of the task, a required one in the route of its agent.
// Some positions are left out at random. Routes that cost more are accepted with a probability that
// falls with their cost and with the effort (simulated annealing). For variants, all routes below a
// limit are accepted. Only the changed routes are restored after a failure.
#include "assignment/assignment_lns.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "model/random.h"

namespace grove::detail {
namespace {

constexpr int kMaxString = 25;           // visits of one route that are removed
constexpr int kMeanRemoved = 12;         // visits of all routes
constexpr std::size_t kNeighbours = 40;  // nearest tasks of a task
constexpr int kBlinks = 100;             // one position in this many is left out
constexpr double kFirstTemperature = 3;  // steps
constexpr double kLastTemperature = 0.1;
constexpr std::int64_t kIterationsPerPoll = 64;

class AssignmentLns {
 public:
  // `cost_limit`: routes of less than this total cost are accepted; nullopt: simulated annealing
  // with an effort of `insertions`.
  AssignmentLns(Routes& routes, const RouteCosts& costs, std::optional<Cost> cost_limit,
                std::int64_t insertions, std::uint64_t seed)
      : routes_(routes),
        best_(routes),
        instance_(costs.instance()),
        random_(seed),
        cost_limit_(cost_limit),
        insertions_(insertions),
        cost_(routes.cost()),
        best_cost_(cost_),
        visitors_(instance_.tasks().size()) {
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      for (const TaskIndex task : routes.stops(agent)) visitors_[task].push_back(agent);
    for (TaskIndex task = 0; task < instance_.task_count(); ++task)
      if (!visitors_[task].empty()) tasks_.push_back(task);
    find_neighbours(costs);
  }

  bool is_over() const { return tasks_.empty() || tried_ >= insertions_; }

  void iterate() {
    ++tried_;
    saved_.clear();
    removed_.clear();
    Cost change = -remove_strings();
    order_removed();
    for (const Visit& visit : removed_) {
      const std::optional<Time> cost = insert(visit);
      if (!cost) return restore();
      change += *cost;
    }
    if (!is_accepted(cost_ + change)) return restore();
    cost_ += change;
    if (cost_limit_ || cost_ >= best_cost_) return;
    best_cost_ = cost_;
    best_ = routes_;
  }

  // Ends the search with the best routes. For variants: with the current ones.
  void finish() {
    if (!cost_limit_) routes_ = std::move(best_);
  }

 private:
  // A visit of `agent`; kAny: of any agent of the task.
  struct Visit {
    TaskIndex task;
    AgentIndex agent;
  };
  static constexpr AgentIndex kAny = -1;
  // An agent's route before an iteration.
  struct Saved {
    AgentIndex agent;
    std::vector<TaskIndex> stops;
  };

  void find_neighbours(const RouteCosts& costs) {
    neighbours_.resize(visitors_.size());
    for (const TaskIndex task : tasks_) {
      const AgentIndex any = instance_.task(task).agents.front();
      std::vector<std::pair<Time, TaskIndex>> near;
      for (const TaskIndex other : tasks_)
        near.emplace_back(costs.between(any, task, other), other);
      const std::size_t count = std::min(kNeighbours, near.size());
      std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(count));
      for (std::size_t k = 0; k < count; ++k) neighbours_[task].push_back(near[k].second);
    }
  }

  // Returns by how much the cost of the routes falls.
  Cost remove_strings() {
    const TaskIndex seed = tasks_[random_.below(tasks_.size())];
    const int longest = 1 + random_.below(kMaxString);
    const int strings = 1 + random_.below(std::max(1, 2 * kMeanRemoved / longest));
    Cost gain = 0;
    for (const TaskIndex task : neighbours_[seed]) {
      if (std::ssize(saved_) >= strings) break;
      const std::vector<AgentIndex> visitors = visitors_[task];
      for (const AgentIndex agent : visitors)
        if (!is_saved(agent)) gain += remove_string(agent, task, longest);
    }
    return gain;
  }
  Cost remove_string(AgentIndex agent, TaskIndex task, int longest) {
    const std::vector<TaskIndex> stops = routes_.stops(agent);
    const auto at = static_cast<int>(std::ranges::find(stops, task) - stops.begin());
    const int first_free = task_at_start(instance_, agent) ? 1 : 0;
    const int length = std::min(longest, static_cast<int>(stops.size()) - first_free);
    if (at < first_free || length == 0) return 0;
    const int least = std::max(first_free, at - length + 1);
    const int most = std::min(at, static_cast<int>(stops.size()) - length);
    const int first = least + random_.below(most - least + 1);
    save(agent);
    Cost gain = 0;
    for (int k = first; k < first + length; ++k) {
      const TaskIndex removed = stops[k];
      removed_.push_back({removed, instance_.task(removed).needs_all() ? agent : kAny});
      std::erase(visitors_[removed], agent);
      gain += routes_.remove(agent, removed);
    }
    return gain;
  }

  // At random, or those far from the start of their first agent first or last.
  void order_removed() {
    random_.shuffle(removed_);
    const auto distance = [&](const Visit& visit) {
      const AgentIndex agent =
          visit.agent == kAny ? instance_.task(visit.task).agents.front() : visit.agent;
      return routes_.costs().from_start(agent, visit.task);
    };
    const int order = random_.below(4);
    if (order == 0) std::ranges::stable_sort(removed_, {}, distance);
    if (order == 1) std::ranges::stable_sort(removed_, std::greater(), distance);
  }

  std::optional<Time> insert(const Visit& visit) {
    Insertion best;
    AgentIndex best_agent = kAny;
    const auto consider = [&](AgentIndex agent) {
      const Insertion here =
          routes_.cheapest(agent, visit.task, [this] { return random_.below(kBlinks) > 0; });
      ++tried_;
      if (here.cost >= best.cost) return;
      best = here;
      best_agent = agent;
    };
    if (visit.agent != kAny)
      consider(visit.agent);
    else
      for (const AgentIndex agent : instance_.task(visit.task).agents) consider(agent);
    if (best_agent == kAny) return std::nullopt;
    save(best_agent);
    routes_.insert(best_agent, visit.task, best.position);
    visitors_[visit.task].push_back(best_agent);
    return best.cost;
  }

  bool is_accepted(Cost cost) {
    if (cost_limit_) return cost < *cost_limit_;
    if (cost <= cost_) return true;
    const double done = static_cast<double>(tried_) / static_cast<double>(insertions_);
    const double temperature =
        kFirstTemperature * std::pow(kLastTemperature / kFirstTemperature, done);
    const double random = (1 + random_.below(1 << 20)) / static_cast<double>(1 << 20);
    return static_cast<double>(cost - cost_) < -temperature * std::log(random);
  }

  bool is_saved(AgentIndex agent) const {
    return std::ranges::find(saved_, agent, &Saved::agent) != saved_.end();
  }
  void save(AgentIndex agent) {
    if (!is_saved(agent)) saved_.push_back({agent, routes_.stops(agent)});
  }
  void restore() {
    for (const Saved& saved : saved_) {
      for (const TaskIndex task : routes_.stops(saved.agent))
        std::erase(visitors_[task], saved.agent);
      routes_.set_stops(saved.agent, saved.stops);
      for (const TaskIndex task : saved.stops) visitors_[task].push_back(saved.agent);
    }
  }

  Routes& routes_;
  Routes best_;
  const Instance& instance_;
  Random random_;
  const std::optional<Cost> cost_limit_;
  const std::int64_t insertions_;
  Cost cost_;  // of the routes
  Cost best_cost_;
  std::vector<TaskIndex> tasks_;                    // with visits
  std::vector<std::vector<AgentIndex>> visitors_;   // by task
  std::vector<std::vector<TaskIndex>> neighbours_;  // by task, the nearest first, with itself
  std::vector<Saved> saved_;
  std::vector<Visit> removed_;
  std::int64_t tried_ = 0;  // insertions into a route, and one per iteration
};

void run(AssignmentLns search, const Limits& limits) {
  for (std::int64_t i = 0; !search.is_over(); ++i) {
    if (i % kIterationsPerPoll == 0 && limits.stop_requested()) break;
    search.iterate();
  }
  search.finish();
}

}  // namespace

void improve_routes(Routes& routes, const RouteCosts& costs, std::int64_t insertions,
                    std::uint64_t seed, const Limits& limits) {
  run(AssignmentLns(routes, costs, std::nullopt, insertions, seed), limits);
}

void vary_routes(Routes& routes, const RouteCosts& costs, Cost cost_limit, std::int64_t insertions,
                 std::uint64_t seed, const Limits& limits) {
  run(AssignmentLns(routes, costs, cost_limit, insertions, seed), limits);
}

}  // namespace grove::detail
