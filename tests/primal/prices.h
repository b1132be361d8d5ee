// SPDX-License-Identifier: MIT
// Dual solutions for tests of the primal search.
#pragma once

#include <memory>
#include <utility>

#include "lagrangian/pricing_queue.h"

namespace grove::detail::testing {

// Returns the dual solution of a Lagrangian bound after at most `rounds` rounds, or nullptr if
// there is none.
inline std::shared_ptr<const DualSolution> dual_solution_of(const Instance& instance,
                                                            const AgentStopsCache& stops,
                                                            int rounds) {
  constexpr Cost kAnyCost = 1'000'000;
  const Tuning tuning;
  auto bound = LagrangianBound::make(instance, stops, tuning);
  if (!bound) return nullptr;
  PricingQueue queue(std::move(bound), tuning);
  Pricer pricer(queue.multipliers(), stops);
  while (!queue.ended() && queue.rounds() < rounds) {
    auto job = queue.next();
    queue.perform(*job, pricer, kAnyCost, 0, {});
    queue.commit(std::move(*job));
  }
  return queue.dual_solution();
}

}  // namespace grove::detail::testing
