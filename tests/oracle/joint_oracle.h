// SPDX-License-Identifier: MIT
// Optimum of tiny instances, by exhaustive search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "model/plan.h"

namespace grove::detail::oracle {

enum class Verdict : std::uint8_t {
  kSolved,
  kInfeasible,  // every reachable joint state was expanded
  kTooLarge,    // more states than allowed: no result
};

struct Answer {
  Verdict verdict = Verdict::kTooLarge;
  std::optional<Plan> plan;  // an optimal plan if solved
  std::size_t states = 0;    // joint states generated
};

// The optimum of `instance` as docs/design.md, section 1, defines it.
Answer solve_jointly(const Instance& instance, std::size_t state_cap = 2'000'000);

}  // namespace grove::detail::oracle
