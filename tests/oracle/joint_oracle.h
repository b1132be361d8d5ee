// SPDX-License-Identifier: MIT
// The truth about tiny instances, by exhaustive search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "model/plan.h"

namespace grove::detail::oracle {

enum class Verdict : std::uint8_t {
  kSolved,
  kInfeasible,  // every joint state that can be reached was looked at
  kTooLarge,    // more states than allowed: nothing is known
};

struct Answer {
  Verdict verdict = Verdict::kTooLarge;
  std::optional<Plan> plan;  // an optimal one, when solved
  std::size_t states = 0;    // joint states generated
};

// The optimum of `instance` as docs/design.md, section 1, defines it.
Answer solve_jointly(const Instance& instance, std::size_t state_cap = 2'000'000);

}  // namespace grove::detail::oracle
