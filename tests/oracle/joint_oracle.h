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
  kInfeasible,  // every reachable joint state was expanded
  kTooLarge,    // more states than `state_cap`, or than a key can number: no result
};

struct Answer {
  Verdict verdict = Verdict::kTooLarge;
  std::optional<Plan> plan;  // an optimal plan if solved, else nullopt
  std::size_t states = 0;    // joint states generated
};

// Returns the optimum of `instance`, as section 1 of docs/design.md defines it.
Answer solve_jointly(const Instance& instance, std::size_t state_cap = 2'000'000);

}  // namespace grove::detail::oracle
