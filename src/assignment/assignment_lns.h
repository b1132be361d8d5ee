// SPDX-License-Identifier: MIT
// Large neighbourhood search over assignments, without conflicts between agents.
#pragma once

#include <cstdint>

#include "assignment/routes.h"
#include "model/limits.h"

namespace grove::detail {

// Improves the routes by slack induction by string removals (Christiaens and Vanden Berghe 2020),
// until `insertions` insertions into a route have been tried or a limit is reached. The result
// never costs more than the given routes. Repeatable.
void improve_routes(Routes& routes, std::int64_t insertions, std::uint64_t seed,
                    const Limits& limits);

// The same, but accepts all routes that cost less than `cost_limit` in total.
void vary_routes(Routes& routes, Cost cost_limit, std::int64_t insertions, std::uint64_t seed,
                 const Limits& limits);

}  // namespace grove::detail
