// SPDX-License-Identifier: MIT
// Repair by a queue of agents without a path. The first agent in the queue gets the best path
// around the agents that have one. If no path exists, or none is found within the label limit, the
// paths of the agents that block its individual path are removed, and these agents are appended to
// the queue. Two agents that enclose each other could alternate forever. Therefore, after many
// failures, the agents that block the individual path with a random delay are removed, too, and the
// number of failures is limited. The delayed path is also used if no agent blocks the individual
// path itself; if no agent blocks the delayed path either, a few random agents are removed.
#include "primal/repair.h"

#include <algorithm>
#include <deque>

#include "model/assert.h"
#include "model/random.h"
#include "planning/planned_paths.h"
#include "primal/primal_low_level.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kFailuresPerAgent = 4;
constexpr std::int64_t kLabels = 10'000;   // label limit of a call: this number,
constexpr std::int64_t kLabelsOfOwn = 50;  // plus this number per step of the individual path
constexpr int kLatest = 8;  // maximum delay, in steps, in the search for blocking agents

class Repair {
 public:
  Repair(const Problem& problem, AgentStopsCache& stops, std::uint64_t seed, const Limits& limits)
      : problem_(problem),
        agents_(problem.instance.agent_count()),
        limits_(limits),
        random_(seed),
        low_level_(problem, stops),
        paths_(problem.instance) {}

  std::optional<Plan> run(const std::vector<Path>& paths) {
    for (AgentIndex agent = 0; agent < agents_; ++agent) {
      if (paths[agent].empty())
        queue_.push_back(agent);
      else
        paths_.put(agent, paths[agent]);
    }
    std::int64_t left = kFailuresPerAgent * agents_;
    while (!queue_.empty()) {
      const AgentIndex agent = queue_.front();
      if (!low_level_.plan_individually(agent, limits_)) return std::nullopt;
      if (plan(agent)) {
        queue_.pop_front();
        continue;
      }
      if (limits_.stop_requested() || left-- == 0) return std::nullopt;
      remove_blocking_agents(agent, ++failures_);
    }
    GROVE_CHECK(std::ranges::none_of(paths_.paths(), &Path::empty),
                "every agent that is not in the queue has a path");
    for (AgentIndex agent = 0; agent < agents_; ++agent)
      if (!low_level_.plan_individually(agent, limits_)) return std::nullopt;
    return low_level_.plan(paths_.paths());
  }

 private:
  bool plan(AgentIndex agent) {
    const PathQuery query{.label_limit = kLabels + kLabelsOfOwn * low_level_.individual_cost(agent),
                          .reservations = &paths_.reservations(),
                          .known_sequences_only = true};
    Path path;
    if (low_level_.find(agent, query, limits_, path) != PathOutcome::kFound) return false;
    paths_.put(agent, std::move(path));
    return true;
  }

  void remove_blocking_agents(AgentIndex agent, std::int64_t failures) {
    const World& world = problem_.instance.world();
    std::vector<AgentIndex> gone;
    const auto note = [&](AgentIndex other) {
      if (std::ranges::find(gone, other) == gone.end()) gone.push_back(other);
      return true;
    };
    for_each_blocking_agent(world, paths_.reservations(), agent, low_level_.individual_path(agent),
                            0, note);
    // After many failures, removing only these agents is not sufficient.
    if (failures > agents_ / 2 || gone.empty())
      for_each_blocking_agent(world, paths_.reservations(), agent,
                              low_level_.individual_path(agent),
                              static_cast<Time>(1 + random_.below(kLatest)), note);
    if (gone.empty()) gone = some_planned();
    GROVE_ASSERT(std::ranges::find(gone, agent) == gone.end(), "an agent does not block itself");
    random_.shuffle(gone);
    for (const AgentIndex other : gone) {
      paths_.take(other);
      queue_.push_back(other);
    }
  }

  std::vector<AgentIndex> some_planned() {
    std::vector<AgentIndex> planned;
    for (AgentIndex agent = 0; agent < agents_; ++agent)
      if (!paths_.path(agent).empty()) planned.push_back(agent);
    random_.shuffle(planned);
    planned.resize(std::min<std::size_t>(planned.size(), 4));
    return planned;
  }

  const Problem& problem_;
  const int agents_;
  const Limits& limits_;
  Random random_;
  PrimalLowLevel low_level_;
  PlannedPaths paths_;
  std::deque<AgentIndex> queue_;
  std::int64_t failures_ = 0;
};

}  // namespace

std::optional<Plan> repaired(const Problem& problem, AgentStopsCache& stops,
                             const std::vector<Path>& paths, std::uint64_t seed,
                             const Limits& limits) {
  return Repair(problem, stops, seed, limits).run(paths);
}

Cost sum_of_individual_costs(const Problem& problem, AgentStopsCache& stops, const Limits& limits) {
  PrimalLowLevel low_level(problem, stops);
  Cost sum = 0;
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    if (low_level.plan_individually(agent, limits))
      sum += low_level.knows_best(agent) ? low_level.individual_cost(agent)
                                         : stops.of(agent).cost_to_go().relaxed_bound();
  return sum;
}

}  // namespace grove::detail
