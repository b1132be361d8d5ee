// SPDX-License-Identifier: MIT
// Prioritised planning: finds a first plan by planning one agent after the other.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "model/random.h"
#include "model/tuning.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/planned_paths.h"
#include "primal/primal_low_level.h"

namespace grove::detail {

// Plans the agents in an order, each around the agents planned before it. When it finds no path for
// an agent, it restarts with a different order or re-plans the agents in the way; see the head of
// the .cpp. One thread at a time.
class PrioritizedPlanning {
 public:
  enum class Outcome : std::uint8_t {
    kWorking,
    kDone,       // all agents have a path
    kPostponed,  // a low-level call reached `max_labels` and is postponed
    kStopped,    // a limit was reached; step() may be called again
  };

  // All references must outlive this object.
  PrioritizedPlanning(const World& world, PrimalLowLevel& low_level, PlannedPaths& paths,
                      Random& random, const Tuning& tuning)
      : world_(world),
        low_level_(low_level),
        paths_(paths),
        random_(random),
        tuning_(tuning),
        unplanned_(world) {}

  // Removes all paths and starts with the agent order `order`. All agents must have individual
  // paths (PrimalLowLevel::plan_individually()).
  void begin(std::vector<AgentIndex> order);
  // Plans one agent. A low-level call that exceeds `max_labels` labels is postponed: the next step
  // repeats it from the start. Must not be called after kDone.
  Outcome step(const Limits& limits,
               std::int64_t max_labels = std::numeric_limits<std::int64_t>::max());

  // Number of orders started so far.
  std::int64_t attempts() const { return attempts_; }
  // Number of failures to find a path since begin().
  std::int64_t failures() const { return failures_; }

 private:
  // The agents in the order in which they are planned. Those before position `next` have paths.
  struct Order {
    std::vector<AgentIndex> agents;
    std::size_t next = 0;
    std::int64_t labels = 0;       // labels since this order was started
    std::vector<bool> has_failed;  // by AgentIndex: failed in this order
  };
  // Labels of the low-level calls that found a path.
  struct LabelsOfFound {
    std::int64_t exact = 0;        // of all exact calls
    std::int64_t exact_calls = 0;  // number of these calls
    std::int64_t max = 0;          // of one call, exact or greedy
  };

  bool is_done() const { return order_.next == order_.agents.size(); }
  void begin_again();
  std::int64_t label_limit() const;
  std::int64_t max_exact_labels() const;
  void remove_blocking_agents(AgentIndex agent);
  void restart_with_failed_first();
  void note_labels(std::int64_t labels);

  const World& world_;
  PrimalLowLevel& low_level_;
  PlannedPaths& paths_;
  Random& random_;
  const Tuning& tuning_;
  Order order_;
  std::int64_t attempts_ = 0;
  std::int64_t failures_ = 0;  // since begin()
  bool greedily_ = false;      // the next call searches greedily
  LabelsOfFound labels_of_found_;
  ConflictAvoidanceTable unplanned_;  // individual paths of the agents without a path
  Path path_;
};

}  // namespace grove::detail
