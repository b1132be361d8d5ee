// SPDX-License-Identifier: MIT
/// \file
/// The public API of Grove. This header includes all of it except grove/mpi.hpp. Only the public
/// API is kept stable.
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
/// Units: cells or metres for places, time steps for plans, seconds for clocks, bytes for memory.
/// Ownership: values are copied. Copies of a World or an Instance share their data, which lives as
/// long as the last copy.
/// Threads: functions are thread-safe. Objects are used by one thread at a time, except immutable
/// ones.
/// Errors: functions throw the exceptions of error.hpp. No function prints, asks for input or ends
/// the process.
#pragma once

#include "grove/error.hpp"
#include "grove/instance.hpp"
#include "grove/plan.hpp"
#include "grove/session.hpp"
#include "grove/solve.hpp"
#include "grove/version.hpp"
#include "grove/world.hpp"

/// The namespace of the library. Names in grove::detail are internal.
namespace grove {}
