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

// Searches the whole instance, or some of its agents with given graphs. The search is exact: it
// ends with paths of least cost or with a proof that there are none. At any time it has a lower
// bound on all plans. One thread at a time.
class EpeaStar {
 public:
  static constexpr int kMaxAgents = 16;

  // Returns nullptr if there are more than kMaxAgents agents, if there are more than 2^`max_bits`
  // joint states (blocked cells included), if the agents' graphs together exceed that size, or if
  // there is not enough memory to start. `instance` must outlive the result. `max_bytes`: its
  // memory limit.
  static std::unique_ptr<EpeaStar> make(const Instance& instance, double max_bits,
                                        std::size_t max_bytes);
  // Searches the agents of these graphs, from 1 to kMaxAgents. `known_bound` is a known lower bound
  // on their total cost. `instance` must outlive this object.
  EpeaStar(const Instance& instance, std::vector<AgentGraph> agents, std::size_t max_bytes,
           Cost known_bound = 0);
  ~EpeaStar();

  enum class Outcome : std::uint8_t {
    kWorking,   // the search is not finished
    kEnded,     // no plan costs less than the cutoff, except that of plan(), if any
    kTooLarge,  // out of memory, or a limit was reached: do not call run() again
  };
  // Expands up to `states` joint states, or makes one pattern database. Ignores plans that cost
  // `cutoff` or more.
  Outcome run(std::int64_t states, Cost cutoff, const Limits& limits);

  // Proven lower bound on every plan that costs less than the cutoffs passed to run().
  // kInfiniteCost: there is no such plan.
  Cost lower_bound() const;
  // paths(): the paths of an optimal plan, in the order of the graphs. plan(): this plan. Both are
  // nullopt until the search has found it.
  const std::optional<std::vector<Path>>& paths() const;
  std::optional<Plan> plan() const;
  // Joint states expanded, and total effort in the unit of search/work.h.
  std::int64_t states() const;
  std::int64_t work() const;

 private:
  class Search;
  explicit EpeaStar(std::unique_ptr<Search> search);
  std::unique_ptr<Search> search_;
};

}  // namespace grove::detail
