// SPDX-License-Identifier: MIT
// The engine: runs the search on an instance until it is done or told to stop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "baselines/low_level.h"
#include "engine/checkpoints.h"
#include "model/limits.h"
#include "model/plan.h"
#include "search/search_options.h"
#include "sequencing/rtsp.h"

namespace grove::detail {

class CheckpointReader;  // grove/engine/checkpoint.h
class RunObserver;       // grove/engine/run_observer.h
struct Problem;          // grove/search/problem.h

// What a tree of the forest fixes about the agents' orders of visits.
enum class Policy : std::uint8_t {
  kAuto,   // the engine's choice: kFree
  kFixed,  // one complete joint task sequence per tree: the paper's CTS-CBS
  kFree,   // one tree for all sequences: the low level chooses the order
};

struct SolveOptions {
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  Omega omega;
  Policy policy = Policy::kAuto;
  RtspBackend rtsp = RtspBackend::kAuto;  // of kFixed
  // Not with kFixed. With another one than Grove's own no technique is used: plain CBS.
  LowLevel low_level = LowLevel::kOwn;
  int threads = 1;  // at least 1
  // What happens depends on the work done alone, not on the threads or the clock: the same plan and
  // the same events for any number of threads, limits aside.
  bool deterministic = false;
  // Breaks ties among conflicts of equal time and guides the primal search; the same seed makes the
  // same run, limits aside.
  std::uint64_t seed = 0;
  // Technique::kPrimal is not used with kFixed.
  Techniques techniques = Techniques::defaults();
  Tuning tuning = {};
  std::optional<Plan> start = std::nullopt;  // the first incumbent, a valid plan
  Checkpoints checkpoints = {};
  // Where an earlier run, of the same instance and policy, is to go on from; null: nowhere. Read by
  // solve(); owned by the caller.
  CheckpointReader* resume = nullptr;
  // The most that open nodes and their ancestors may hold, in bytes; beyond, the worst are given
  // up. Without a word from here the memory limit of the run decides.
  std::size_t node_memory = kUnlimited;
  // See SearchOptions::audit.
  bool audit = false;
  // See SearchOptions::proof. Must outlive the run.
  ProofLog* proof = nullptr;
};

// Solves `instance` to `options.omega`, or until `limits` strike; always returns a proven lower
// bound. `observer` (may be null) is told what happens, from any of the threads, one at a time.
// Throws what the observer throws, what reading the checkpoint throws (InputError), and
// std::logic_error or std::runtime_error when a part of the search turns out to be broken (a plan
// that the checker refuses, `options.start` included; CBC failing).
Solution solve(const Instance& instance, const SolveOptions& options, const Limits& limits,
               RunObserver* observer = nullptr);

// The same of a problem that somebody keeps.
Solution solve(const Problem& problem, const SolveOptions& options, const Limits& limits,
               RunObserver* observer = nullptr);

// The answer where there is no search to be made: the instance is seen to have no plan, or limits
// struck before `problem` was complete. None: search. For engines.
std::optional<Solution> presolve(const Problem& problem, const SolveOptions& options,
                                 const Limits& limits, RunObserver& observer);

}  // namespace grove::detail
