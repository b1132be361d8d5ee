// SPDX-License-Identifier: MIT
/// \file
/// Grove's public API: everything that users of the library need, and all that is kept stable.
///
///     #include <grove/grove.hpp>
///
///     const grove::World world = grove::World::from_rows({"....",
///                                                         ".@@.",
///                                                         "...."});
///     const grove::Instance instance(world,
///         {{.id = "red", .start = {grove::Cell{0, 0}}, .goal = grove::Cell{3, 2}},
///          {.id = "blue", .start = {grove::Cell{3, 0}}, .goal = grove::Cell{0, 2}}},
///         {{.id = "press", .place = grove::Cell{1, 2}, .agents = {"red", "blue"},
///           .duration = 3}});
///     const grove::Solution solution = grove::solve(instance, {.omega = 0.1, .time_limit = 10});
///
/// Units: cells or metres for places, steps for time, seconds for clocks, bytes for memory. Values
/// are copied; World, Instance and what they share live as long as somebody holds them. Functions
/// may be called from any thread, several at a time; of objects that are not immutable, one thread
/// at a time uses each. Nothing here prints, exits or asks; what is thrown is in error.hpp.
#pragma once

#include "grove/error.hpp"
#include "grove/instance.hpp"
#include "grove/plan.hpp"
#include "grove/session.hpp"
#include "grove/solve.hpp"
#include "grove/version.hpp"
#include "grove/world.hpp"

/// Grove's library. Names in grove::detail are not for users.
namespace grove {}
