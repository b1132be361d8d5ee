// SPDX-License-Identifier: MIT
// What at most one agent uses once, in any plan.
#pragma once

#include <cstdint>

#include "model/plan.h"

namespace grove::detail {

// What many use and pay for. `a`, `b`: of kPlace a place, of kEdge two neighbours, the lesser one
// first, of kFinish two agents.
struct RelaxedRow {
  enum class Kind : std::uint8_t { kPlace, kEdge, kFinish };
  Kind kind = Kind::kPlace;
  std::int32_t a = 0;
  std::int32_t b = 0;
  Time time = 0;    // of kFinish: by which a finishes
  Time time_b = 0;  // only of kFinish

  friend bool operator==(const RelaxedRow&, const RelaxedRow&) = default;
};

// With what its use costs: of 1024, that make a step.
struct RowMultiplier {
  RelaxedRow row;
  std::int32_t charge = 0;
};

}  // namespace grove::detail
