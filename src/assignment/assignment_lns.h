// SPDX-License-Identifier: MIT
// Large neighbourhood search over assignments, without conflicts between agents.
#pragma once

#include <cstdint>

#include "assignment/routes.h"
#include "model/limits.h"

namespace grove::detail {

// Improves the routes (Shaw 1998; Ropke and Pisinger 2006): removes optional visits of tasks that
// are close to each other and inserts them again, until `insertions` insertions into a route have
// been tried or a limit is reached. Routes never become more expensive. `costs` must be those of
// the routes. Repeatable.
void improve_routes(Routes& routes, const RouteCosts& costs, std::int64_t insertions,
                    std::uint64_t seed, const Limits& limits);

// The same, but accepts all routes that cost less than `cost_limit` in total.
void vary_routes(Routes& routes, const RouteCosts& costs, Cost cost_limit, std::int64_t insertions,
                 std::uint64_t seed, const Limits& limits);

}  // namespace grove::detail
