// SPDX-License-Identifier: MIT
// A* over joint states (EPEA*, Goldenberg et al. 2014), for few agents that are all in each other's
// way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "joint/agent_graph.h"
#include "model/limits.h"
#include "model/plan.h"

namespace grove::detail {

// Searches the whole instance, or some of its agents with given graphs. Exact: it ends with paths
// of least cost or with the proof that there are none. At every moment it has a lower bound on all
// plans. One thread at a time.
class EpeaStar {
 public:
  static constexpr int kMaxAgents = 16;

  // Returns nullptr if there are more than kMaxAgents agents or more than 2^`max_bits` joint
  // states, blocked cells included, or if there is no memory to begin with. `instance` must outlive
  // it. `max_bytes`: its memory limit.
  static std::unique_ptr<EpeaStar> make(const Instance& instance, double max_bits,
                                        std::size_t max_bytes);
  // Searches the agents of these graphs: at least 1 and at most kMaxAgents. `known_bound` is a
  // known lower bound on their cost.
  EpeaStar(const Instance& instance, std::vector<AgentGraph> agents, std::size_t max_bytes,
           Cost known_bound = 0);
  ~EpeaStar();

  enum class Outcome : std::uint8_t {
    kWorking,   // there is more to do
    kEnded,     // no plan costs less than the cutoff, except that of paths() if present
    kTooLarge,  // out of memory or stopped: do not call run() again
  };
  // Expands up to `states` joint states, or makes one pattern database. Ignores plans that cost
  // `cutoff` or more.
  Outcome run(std::int64_t states, Cost cutoff, const Limits& limits);

  // Proven: no plan costs less, except plans that cost the cutoff or more. kInfiniteCost: there is
  // no other plan.
  Cost lower_bound() const;
  // Paths of an optimal plan, in the order of the graphs, and this plan. nullopt until it is found.
  const std::optional<std::vector<Path>>& paths() const;
  std::optional<Plan> plan() const;
  // Joint states expanded, and total work in the unit of search/work.h.
  std::int64_t states() const;
  std::int64_t work() const;

 private:
  class Search;
  explicit EpeaStar(std::unique_ptr<Search> search);
  std::unique_ptr<Search> search_;
};

}  // namespace grove::detail
