// SPDX-License-Identifier: MIT
// Several threads on one search.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/worker.h"

namespace grove::detail {

// What any thread does between turns: other things than searching, if they are due.
using BetweenItems = std::function<void()>;

// Lets the worker run until the search is over.
void run_single_threaded(Worker& worker, const SharedSearch& shared,
                         const BetweenItems& between_turns);

// Lets every worker run on a thread of its own until the search is over; then ends what is still
// under way. Throws what a worker throws, after all have stopped.
void run_parallel(std::span<const std::unique_ptr<Worker>> workers, SharedSearch& shared,
                  const Limits& limits, const BetweenItems& between_turns);

// The workers of a deterministic run, whatever the number of threads.
inline constexpr int kDeterministicWorkers = 4;

// In rounds: the workers choose one after the other, perform side by side on so many threads, and
// commit one after the other. So what happens does not depend on how many threads there are.
void run_deterministic(std::span<const std::unique_ptr<Worker>> workers, SharedSearch& shared,
                       int threads, const BetweenItems& between_turns);

}  // namespace grove::detail
