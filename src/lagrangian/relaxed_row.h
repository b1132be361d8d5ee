// SPDX-License-Identifier: MIT
// Relaxed row: a constraint "at most one use", satisfied by every plan.
#pragma once

#include <cstdint>

#include "model/plan.h"

namespace grove::detail {

// In any plan at most one agent uses a row, and it uses it once (proof: relaxed_rows.cpp). `a`,
// `b`: of kPlace a place (only a), of kEdge two neighbours, the lesser one first, of kFinish two
// agents.
struct RelaxedRow {
  enum class Kind : std::uint8_t { kPlace, kEdge, kFinish };
  Kind kind = Kind::kPlace;
  std::int32_t a = 0;
  std::int32_t b = 0;
  Time time = 0;    // of kFinish: latest finish of agent a
  Time time_b = 0;  // only of kFinish: latest finish of agent b

  friend bool operator==(const RelaxedRow&, const RelaxedRow&) = default;
};

// A row and its multiplier in units of 1/1024 step.
struct RowMultiplier {
  RelaxedRow row;
  std::int32_t multiplier = 0;
};

}  // namespace grove::detail
