// SPDX-License-Identifier: MIT
// All that a tiny crowd can come to, by exhaustive search.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "model/instance.h"

namespace grove::detail::oracle {

// By agent: its place.
using Places = std::vector<Place>;

// The arrangements that come of the starts by steps in which nobody collides, whoever turns taken
// for one that turns freely; empty if there are more than `most`.
std::set<Places> arrangements_from_starts(const Instance& instance, std::size_t most);

}  // namespace grove::detail::oracle
