// SPDX-License-Identifier: MIT
// Runs the workers of a process on one or several threads.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/worker.h"

namespace grove::detail {

// Function that is called, on any thread, between two work items of a worker or between two rounds
// (see run_deterministic()), for instance to write a checkpoint.
using BetweenItems = std::function<void()>;

// Runs the worker until the search is over.
void run_single_threaded(Worker& worker, const Components& components,
                         const BetweenItems& between_turns);

// Runs every worker on a thread of its own until the search is over, then cancels the work items in
// progress. If a worker throws std::bad_alloc, the run ends as at the memory limit. Any other
// exception of a worker is rethrown after all threads have stopped.
void run_parallel(std::span<const std::unique_ptr<Worker>> workers, const Components& components,
                  const Limits& limits, const BetweenItems& between_turns);

// Number of workers of a deterministic run, whatever the number of threads.
inline constexpr int kDeterministicWorkers = 4;

// Runs the workers in rounds: they choose work items one worker after the other, perform them
// concurrently on up to `threads` threads, and commit them one worker after the other. Therefore
// the result does not depend on `threads`, unless a limit is reached.
void run_deterministic(std::span<const std::unique_ptr<Worker>> workers,
                       const Components& components, int threads,
                       const BetweenItems& between_turns);

}  // namespace grove::detail
