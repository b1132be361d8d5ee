// SPDX-License-Identifier: MIT
// LaCAM with restarts: finds first plans, in particular for dense instances, by joint steps of all
// agents.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "model/limits.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "planning/problem.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Searches for any valid plan, without optimising its cost, in slices of any length. Restarts after
// first_steps joint steps, and then each time after twice as many. Deterministic: the same
// arguments yield the same plan, however the search is divided into slices. One thread at a time.
class LacamWithRestarts {
 public:
  enum class Outcome : std::uint8_t {
    kFound,      // there is a plan()
    kExhausted,  // every reachable configuration was expanded and none is a goal, or an agent
                 // cannot visit its stops in its order (lacam.cpp). Not used as a proof of
                 // infeasibility
    kWorking,    // the slice is used up
    kStopped,    // a limit was reached, or so little memory is left that continuing would reach one
  };

  // `orders`: by AgentIndex, the complete sequence in which the agent heads for its stops. Stops
  // that it passes earlier count as visited. An agent without a destination heads for the last stop
  // of its sequence to rest there. Every complete sequence is accepted; good ones yield good plans
  // (visit_orders.h). `problem` must outlive this object. Throws std::invalid_argument if an order
  // is missing or not complete.
  LacamWithRestarts(const Problem& problem, std::span<const Sequence> orders, std::uint64_t seed,
                    std::int64_t first_steps = Tuning().lacam_first_steps);
  ~LacamWithRestarts();
  LacamWithRestarts(LacamWithRestarts&&) noexcept;
  LacamWithRestarts& operator=(LacamWithRestarts&&) noexcept;

  // Makes at most `slice` joint steps. A joint step takes about 0.15 us per agent. Can be called
  // again after kWorking and kStopped.
  Outcome run(const Limits& limits, std::int64_t slice);

  const std::optional<Plan>& plan() const;
  // Joint steps made so far.
  std::int64_t steps() const;
  // Number of configurations stored by the current search.
  std::int64_t configurations() const;

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace grove::detail
