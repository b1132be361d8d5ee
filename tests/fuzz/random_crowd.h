// SPDX-License-Identifier: MIT
// Dense instances (pebble motion), on maps where every step can be undone.
#pragma once

#include <cstdint>
#include <string>

#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// Returns an instance that consists of agents and their starts, on up to nine places of any shape,
// on a grid or a roadmap, possibly without a free place. The same seed gives the same instance.
TinyInstance tiny_crowd(std::uint64_t seed);

// An instance in which all agents have goals and it is known whether a plan exists. The goals come
// from a random plan and are possibly changed in a way that provably leaves no plan.
struct KnownCrowd {
  Instance instance;
  bool has_plan;
  std::string board;
};

// Returns an instance with about 10 to 2,000 agents. The same seed gives the same instance.
KnownCrowd known_crowd(std::uint64_t seed);

}  // namespace grove::detail::fuzz
