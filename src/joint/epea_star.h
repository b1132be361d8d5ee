// SPDX-License-Identifier: MIT
// A* over joint states (EPEA*, Goldenberg et al. 2014), for few agents all of which obstruct one
// another.
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

// Searches the whole instance, or some of its agents with given graphs. The search is exact: unless
// it is aborted, it ends with an optimal plan or with a proof that no plan costs less than the
// cutoff. It has a lower bound at any time. One thread at a time.
class EpeaStar {
 public:
  static constexpr int kMaxAgents = 16;

  // Returns nullptr if there are more than kMaxAgents agents, if there are more than 2^`max_bits`
  // joint states (blocked cells included), if the product of the sizes of the agents' graphs
  // exceeds that number, if one graph exceeds AgentGraph::kMaxNodes, or if there is not enough
  // memory to start. `instance` must outlive the result. `max_bytes`: limit on the memory of
  // the search.
  static std::unique_ptr<EpeaStar> make(const Instance& instance, double max_bits,
                                        std::size_t max_bytes);
  // Searches the agents of these graphs (1 to kMaxAgents), without pattern databases. `known_bound`
  // is a known lower bound on their total cost. `instance` must outlive this object.
  EpeaStar(const Instance& instance, std::vector<AgentGraph> agents, std::size_t max_bytes,
           Cost known_bound = 0);
  ~EpeaStar();

  enum class Outcome : std::uint8_t {
    kWorking,   // the search is not finished
    kEnded,     // plan() is optimal or, if it is nullopt, no plan costs less than the cutoff
    kTooLarge,  // out of memory, or a limit was reached: do not call run() again
  };
  // Expands up to `states` joint states, or makes one pattern database. Ignores plans that cost
  // `cutoff` or more; a later call must not have a greater cutoff.
  Outcome run(std::int64_t states, Cost cutoff, const Limits& limits);

  // Proven lower bound on every plan that costs less than all cutoffs passed to run() so far.
  // kInfiniteCost: there is no such plan.
  Cost lower_bound() const;
  // paths(): the paths of an optimal plan, in the order of the graphs. plan(): this plan. Both are
  // nullopt until the search has found it.
  const std::optional<std::vector<Path>>& paths() const;
  std::optional<Plan> plan() const;
  // Joint states expanded, and total effort in the unit of model/effort.h.
  std::int64_t states() const;
  std::int64_t work() const;

 private:
  class Search;
  explicit EpeaStar(std::unique_ptr<Search> search);
  std::unique_ptr<Search> search_;
};

}  // namespace grove::detail
