// SPDX-License-Identifier: MIT
// Optimum of tiny instances, found by exhaustive search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "model/plan.h"

namespace grove::detail::oracle {

enum class Verdict : std::uint8_t {
  kSolved,
  kInfeasible,  // there is no plan
  // No result: there are more joint states than `state_cap` or than a 64-bit key can number, or
  // more than 2^20 states of one agent.
  kTooLarge,
};

struct Answer {
  Verdict verdict = Verdict::kTooLarge;
  std::optional<Plan> plan;  // an optimal plan if solved, else nullopt
  std::size_t states = 0;    // joint states generated
};

// Returns the optimum of `instance`, as section 1 of docs/design.md defines it.
Answer solve_jointly(const Instance& instance, std::size_t state_cap = 2'000'000);

}  // namespace grove::detail::oracle
