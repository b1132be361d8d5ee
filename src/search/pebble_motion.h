// SPDX-License-Identifier: MIT
// Presolve test by pebble motion: detects that too few places are free for the agents to pass each
// other.
#pragma once

#include <optional>
#include <string>

#include "model/instance.h"

namespace grove::detail {

// Returns a sentence that explains why the instance has no plan, or nullopt if this test cannot
// prove that. If every step can be undone, every agent has a goal, and each place is connected with
// the starts of the agents that must visit it, nullopt means that a plan exists.
std::optional<std::string> pebble_motion_infeasibility(const Instance& instance);

}  // namespace grove::detail
