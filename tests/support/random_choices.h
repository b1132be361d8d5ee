// SPDX-License-Identifier: MIT
// Random choices for instances without choices.
#pragma once

#include <cstdint>

#include "model/instance.h"

namespace grove::detail {

// Returns `instance` with choices: some tasks have further agents and need only some of their
// agents, some agents with a destination choose it among several, and some places have further
// tasks. The same seed gives the same instance. The result can be without choices, or without a
// plan.
Instance with_random_choices(const Instance& instance, std::uint64_t seed);

}  // namespace grove::detail
