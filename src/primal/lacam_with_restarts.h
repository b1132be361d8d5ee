// SPDX-License-Identifier: MIT
// First plans on crowded maps: all agents move at once, one joint step after the other (LaCAM).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "model/limits.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "search/problem.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Searches for any valid plan, in slices as short as one likes; cheap plans are not its business.
// Begins anew when it takes long. The same arguments make the same plan, however the work is
// sliced. One thread at a time.
class LacamWithRestarts {
 public:
  enum class Outcome : std::uint8_t {
    kFound,      // there is a plan()
    kExhausted,  // every joint state that can be reached was expanded, and none is an end.
                 // Heuristic code: nobody should take that for a proof
    kWorking,    // the slice is used up
    kStopped,    // a limit struck, or so little memory is left that going on would make one strike
  };

  // `orders`: in what order each agent heads for its stops, a complete sequence by AgentIndex;
  // stops met on the way count too. An agent without a destination heads for the last one to rest
  // there. Any orders will do; good ones make good plans (visit_orders.h). `problem` must outlive
  // this. It begins anew after `first_steps`, then after twice as many, and so on. Throws
  // std::invalid_argument for an order that is not complete.
  LacamWithRestarts(const Problem& problem, std::span<const Sequence> orders, std::uint64_t seed,
                    std::int64_t first_steps = Tuning().first_joint_steps);
  ~LacamWithRestarts();
  LacamWithRestarts(LacamWithRestarts&&) noexcept;
  LacamWithRestarts& operator=(LacamWithRestarts&&) noexcept;

  // Makes at most `slice` joint steps, each some 0.15 us for every agent. May be called again after
  // kWorking and kStopped.
  Outcome run(const Limits& limits, std::int64_t slice);

  const std::optional<Plan>& plan() const;
  // Joint steps made so far.
  std::int64_t steps() const;
  // Joint states kept now.
  std::int64_t configurations() const;

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace grove::detail
