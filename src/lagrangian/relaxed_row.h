// SPDX-License-Identifier: MIT
// Relaxed row: a constraint of the form "at most one use", which every plan satisfies.
#pragma once

#include <cstdint>

#include "model/plan.h"

namespace grove::detail {

// A plan uses each row at most once (relaxed_rows.cpp defines the uses and has the proof). For
// kPlace, `a` is a place. For kEdge, `a` < `b` are neighbouring places. For kFinish, `a` and `b`
// are agents.
struct RelaxedRow {
  enum class Kind : std::uint8_t { kPlace, kEdge, kFinish };
  Kind kind = Kind::kPlace;
  std::int32_t a = 0;
  std::int32_t b = 0;
  Time time = 0;    // kPlace, kEdge: the (arrival) time; kFinish: latest finish of agent a
  Time time_b = 0;  // kFinish only: latest finish of agent b

  friend bool operator==(const RelaxedRow&, const RelaxedRow&) = default;
};

// A row and its multiplier, in units of 1 / 1024 step (Penalties::kUnit).
struct RowMultiplier {
  RelaxedRow row;
  std::int32_t multiplier = 0;
};

}  // namespace grove::detail
