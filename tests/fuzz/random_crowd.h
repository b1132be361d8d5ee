// SPDX-License-Identifier: MIT
// Crowds with little room, on maps where every step can be undone.
#pragma once

#include <cstdint>
#include <string>

#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// Up to nine places of all shapes, grids and roads, full ones among them: agents and their starts,
// nothing else. The same seed makes the same one.
TinyInstance tiny_crowd(std::uint64_t seed);

// All have goals, and it is known whether there is a plan: it was made by one, or broken in a way
// that anybody can see.
struct KnownCrowd {
  Instance instance;
  bool has_plan;
  std::string board;
};

// Of 10 to 2,000 agents.
KnownCrowd known_crowd(std::uint64_t seed);

}  // namespace grove::detail::fuzz
