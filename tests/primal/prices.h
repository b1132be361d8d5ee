// SPDX-License-Identifier: MIT
// Dual solutions for tests of the primal search.
#pragma once

#include <memory>
#include <utility>

#include "lagrangian/lagrangian_bound.h"

namespace grove::detail::testing {

// Returns the dual solution of a Lagrangian bound after at most `rounds` rounds, or nullptr if
// there is none.
inline std::shared_ptr<const DualSolution> dual_solution_of(const Instance& instance,
                                                            const AgentStopsCache& stops,
                                                            int rounds) {
  constexpr Cost kAnyCost = 1'000'000;
  const Tuning tuning;
  const auto bound = LagrangianBound::make(instance, stops, tuning);
  if (!bound) return nullptr;
  Pricer pricer(bound->multipliers(), stops);
  while (!bound->ended() && bound->rounds() < rounds) {
    auto job = bound->next();
    bound->perform(*job, pricer, kAnyCost, 0, {});
    bound->commit(std::move(*job));
  }
  return bound->dual_solution();
}

}  // namespace grove::detail::testing
