// SPDX-License-Identifier: MIT
// Crowds that cannot get to where they must: too few places are free for who is in whose way.
#pragma once

#include <optional>
#include <string>

#include "model/instance.h"

namespace grove::detail {

// Why the instance has no plan, as a sentence for a person; none if that cannot be seen here. Where
// every step can be undone and every agent has a goal none means that it has one, if each place is
// connected with the starts of those who must visit it.
std::optional<std::string> pebble_motion_infeasibility(const Instance& instance);

}  // namespace grove::detail
