// SPDX-License-Identifier: MIT
// An iteration removes a random optional visit and those of the nearest tasks, and inserts them
// again one by one: in random order, each at its cheapest position in the routes of all its agents.
// Routes of equal cost are accepted. For variants, costs of insertions are random to some extent,
// and all routes below a limit are accepted. Only the changed routes are restored after a failure.
#include "assignment/assignment_lns.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "model/random.h"

namespace grove::detail {
namespace {

constexpr Time kMaxRandomCost = 4;       // steps, added to the costs of insertions for variants
constexpr int kMaxRemoved = 10;          // visits per iteration
constexpr std::size_t kNeighbours = 24;  // nearest tasks of a task, of which some are removed
constexpr std::int64_t kIterationsPerPoll = 64;

class AssignmentLns {
 public:
  // `cost_limit`: routes of less than this total cost are accepted; nullopt: only routes that cost
  // no more than the current ones.
  AssignmentLns(Routes& routes, const RouteCosts& costs, std::optional<Cost> cost_limit,
                std::uint64_t seed)
      : routes_(routes),
        instance_(costs.instance()),
        random_(seed),
        cost_limit_(cost_limit),
        cost_(routes.cost()),
        visitors_(task_count()) {
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      for (const TaskIndex task : routes.stops(agent))
        if (is_free(agent, task)) visitors_[task].push_back(agent);
    for (TaskIndex task = 0; task < instance_.task_count(); ++task)
      if (!visitors_[task].empty()) tasks_.push_back(task);
    find_neighbours(costs);
  }

  bool has_visits() const { return !tasks_.empty(); }
  // The number of insertions into a route tried so far, and one per iteration.
  std::int64_t tried() const { return tried_; }

  void iterate() {
    ++tried_;
    saved_.clear();
    removed_.clear();
    Cost change = -remove_some();
    random_.shuffle(removed_);
    for (const TaskIndex task : removed_) {
      const std::optional<Time> cost = insert(task);
      if (!cost) return restore();
      change += *cost;
    }
    if (cost_limit_ ? cost_ + change >= *cost_limit_ : change > 0) return restore();
    cost_ += change;
  }

 private:
  // An agent's route before an iteration.
  struct Saved {
    AgentIndex agent;
    std::vector<TaskIndex> stops;
  };

  std::size_t task_count() const { return instance_.tasks().size(); }

  // May the visit be removed?
  bool is_free(AgentIndex agent, TaskIndex task) const {
    return !instance_.task(task).needs_all() && task_at_start(instance_, agent) != task;
  }

  void find_neighbours(const RouteCosts& costs) {
    neighbours_.resize(task_count());
    for (const TaskIndex task : tasks_) {
      const AgentIndex any = instance_.task(task).agents.front();
      std::vector<std::pair<Time, TaskIndex>> near;
      for (const TaskIndex other : tasks_)
        if (other != task) near.emplace_back(costs.between(any, task, other), other);
      const std::size_t count = std::min(kNeighbours, near.size());
      std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(count));
      for (std::size_t k = 0; k < count; ++k) neighbours_[task].push_back(near[k].second);
    }
  }

  // Returns by how much the cost of the routes falls.
  Cost remove_some() {
    const TaskIndex seed = tasks_[random_.below(tasks_.size())];
    Cost gain = remove(seed);
    const int count = random_.below(kMaxRemoved);
    const std::vector<TaskIndex>& near = neighbours_[seed];
    for (int k = 0; k < count && !near.empty(); ++k) {
      const TaskIndex task = near[random_.below(near.size())];
      if (!visitors_[task].empty()) gain += remove(task);
    }
    return gain;
  }
  Cost remove(TaskIndex task) {
    std::vector<AgentIndex>& visitors = visitors_[task];
    const std::size_t which = random_.below(visitors.size());
    const AgentIndex agent = visitors[which];
    save(agent);
    visitors.erase(visitors.begin() + static_cast<std::ptrdiff_t>(which));
    removed_.push_back(task);
    return routes_.remove(agent, task);
  }
  std::optional<Time> insert(TaskIndex task) {
    Insertion best;
    AgentIndex best_agent = -1;
    Time least = kNever;
    for (const AgentIndex agent : instance_.task(task).agents) {
      const Insertion here = routes_.cheapest(agent, task);
      ++tried_;
      if (here.cost >= kNever) continue;
      const Time noisy = cost_limit_ ? here.cost + random_.below(kMaxRandomCost + 1) : here.cost;
      if (noisy >= least) continue;
      best = here;
      best_agent = agent;
      least = noisy;
    }
    if (best_agent < 0) return std::nullopt;
    save(best_agent);
    routes_.insert(best_agent, task, best.position);
    visitors_[task].push_back(best_agent);
    return best.cost;
  }

  void save(AgentIndex agent) {
    const auto same = [&](const Saved& saved) { return saved.agent == agent; };
    if (std::ranges::none_of(saved_, same)) saved_.push_back({agent, routes_.stops(agent)});
  }
  void restore() {
    for (const Saved& saved : saved_) {
      for (const TaskIndex task : routes_.stops(saved.agent))
        std::erase(visitors_[task], saved.agent);
      routes_.set_stops(saved.agent, saved.stops);
      for (const TaskIndex task : saved.stops)
        if (is_free(saved.agent, task)) visitors_[task].push_back(saved.agent);
    }
  }

  Routes& routes_;
  const Instance& instance_;
  Random random_;
  const std::optional<Cost> cost_limit_;
  Cost cost_;                                       // of the routes
  std::vector<TaskIndex> tasks_;                    // with a visit that may be removed
  std::vector<std::vector<AgentIndex>> visitors_;   // by task: agents whose visit may be removed
  std::vector<std::vector<TaskIndex>> neighbours_;  // by task, the nearest first
  std::vector<Saved> saved_;
  std::vector<TaskIndex> removed_;
  std::int64_t tried_ = 0;
};

void run(AssignmentLns search, std::int64_t insertions, const Limits& limits) {
  if (!search.has_visits()) return;
  for (std::int64_t i = 0; search.tried() < insertions; ++i) {
    if (i % kIterationsPerPoll == 0 && limits.stop_requested()) return;
    search.iterate();
  }
}

}  // namespace

void improve_routes(Routes& routes, const RouteCosts& costs, std::int64_t insertions,
                    std::uint64_t seed, const Limits& limits) {
  run(AssignmentLns(routes, costs, std::nullopt, seed), insertions, limits);
}

void vary_routes(Routes& routes, const RouteCosts& costs, Cost cost_limit, std::int64_t insertions,
                 std::uint64_t seed, const Limits& limits) {
  run(AssignmentLns(routes, costs, cost_limit, seed), insertions, limits);
}

}  // namespace grove::detail
