// SPDX-License-Identifier: MIT
// Few agents, where everybody is in everybody's way: A* over joint states.
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

// The whole instance at once, or some of its agents as their graphs have it. Exact: it ends with
// paths of least cost, or the proof that there are none; and at every moment it knows a lower bound
// on all. For one thread at a time.
class EpeaStar {
 public:
  static constexpr int kMostAgents = 16;

  // None: not for this method, since there are more agents or more than 2^`most_bits` joint states,
  // blocked cells counted; or there is no memory to begin with.
  // `instance` must outlive it. `most_bytes`: that it may hold.
  static std::unique_ptr<EpeaStar> make(const Instance& instance, double most_bits,
                                        std::size_t most_bytes);
  // Of the agents that these graphs are of, at least one and at most kMostAgents. It is known that
  // they cost `least` or more.
  EpeaStar(const Instance& instance, std::vector<AgentGraph> agents, std::size_t most_bytes,
           Cost least = 0);
  ~EpeaStar();

  enum class Outcome : std::uint8_t {
    kWorking,   // there is more to do
    kEnded,     // there is no plan below the cutoff but that of paths(), if they are there
    kTooLarge,  // out of memory or stopped: it is not to be run again
  };
  // Looks at so many joint states, or makes a table that guides it. Plans that cost `cutoff` or
  // more are of no interest.
  Outcome run(std::int64_t states, Cost cutoff, const Limits& limits);

  // Proven: no plan costs less, but those that cost the cutoff or more. kInfiniteCost: there is
  // none.
  Cost lower_bound() const;
  // Those of an optimal plan, if it has been found, by the order of the graphs; and it.
  const std::optional<std::vector<Path>>& paths() const;
  std::optional<Plan> plan() const;
  // Joint states looked at; and what all has cost, in the unit of search/work.h.
  std::int64_t states() const;
  std::int64_t work() const;

 private:
  class Search;
  explicit EpeaStar(std::unique_ptr<Search> search);
  std::unique_ptr<Search> search_;
};

}  // namespace grove::detail
