// SPDX-License-Identifier: MIT
// A first plan: one agent after the other.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "model/random.h"
#include "model/tuning.h"
#include "primal/planned_paths.h"
#include "primal/primal_low_level.h"

namespace grove::detail {

// Plans the agents in an order, each around those before it, and begins again in another order when
// one of them has no path. The argument for the other order is at the head of the .cpp.
class PrioritizedPlanning {
 public:
  enum class Outcome : std::uint8_t {
    kWorking,
    kDone,     // all agents have a path
    kPutOff,   // the call took too long
    kStopped,  // a limit struck; step() may be called again
  };

  // All must outlive this.
  PrioritizedPlanning(const World& world, PrimalLowLevel& router, PlannedPaths& paths,
                      Random& random, const Tuning& tuning)
      : world_(world), router_(router), paths_(paths), random_(random), tuning_(tuning) {}

  // Takes all paths away and begins; agents must have been met.
  void begin(std::vector<AgentIndex> order);
  // Plans one agent. A call of the low level that takes more than `patience` labels is put off to
  // the next step, where it begins again. Not to be called after kDone.
  Outcome step(const Limits& limits,
               std::int64_t patience = std::numeric_limits<std::int64_t>::max());

  // Orders begun so far.
  std::int64_t attempts() const { return attempts_; }
  // Agents that had no path, since begin().
  std::int64_t failures() const { return failures_; }

 private:
  void begin_again();
  std::int64_t label_limit() const;
  std::int64_t most_exact_labels() const;
  void remove_blocking_agents(AgentIndex agent);
  void begin_with_next();
  void note_labels(std::int64_t labels);

  const World& world_;
  PrimalLowLevel& router_;
  PlannedPaths& paths_;
  Random& random_;
  const Tuning& tuning_;
  std::vector<AgentIndex> order_;
  std::size_t next_ = 0;  // in order_
  std::int64_t attempts_ = 0;
  bool greedily_ = false;             // the next call looks for any path
  std::int64_t labels_of_order_ = 0;  // since this order was begun
  std::vector<bool> has_failed_;      // by AgentIndex, since then
  std::int64_t failures_ = 0;         // since begin()
  std::int64_t labels_of_exact_ = 0;  // of all calls that found the best path
  std::int64_t found_exactly_ = 0;    // such calls
  std::int64_t labels_of_found_ = 0;  // the most that a call with a path took
  Path path_;
};

}  // namespace grove::detail
