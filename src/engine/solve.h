// SPDX-License-Identifier: MIT
// The engine: searches an instance until it is solved or a limit is reached.
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

class CheckpointReader;  // engine/checkpoint.h
class RunObserver;       // engine/run_observer.h
struct Problem;          // search/problem.h

// What a tree of the forest fixes about the sequences of the agents.
enum class Policy : std::uint8_t {
  kAuto,   // the engine's choice: kFree
  kFixed,  // one complete joint task sequence per tree: the paper's CTS-CBS
  kFree,   // one tree for all sequences: the low level chooses the order
};

struct SolveOptions {
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  Omega omega;
  Policy policy = Policy::kAuto;
  RtspBackend rtsp = RtspBackend::kAuto;  // for kFixed
  // Only kOwn with kFixed. With a low level other than kOwn no technique is used: plain CBS.
  LowLevel low_level = LowLevel::kOwn;
  int threads = 1;  // at least 1
  // The run depends only on the work done, not on threads or clock: the same plan and the same
  // events for any number of threads, unless a limit is reached.
  bool deterministic = false;
  // Breaks ties among conflicts of equal time and seeds the primal search. The same seed gives the
  // same run (one thread, or deterministic), unless a limit is reached.
  std::uint64_t seed = 0;
  // Technique::kPrimal is not used with kFixed.
  Techniques techniques = Techniques::defaults();
  Tuning tuning = {};
  std::optional<Plan> start = std::nullopt;  // the first incumbent, a valid plan
  Checkpoints checkpoints = {};
  // Checkpoint of an earlier run of the same instance and policy, to resume from; nullptr: none.
  // Read by solve(); owned by the caller.
  CheckpointReader* resume = nullptr;
  // Max. bytes of open nodes and their ancestors; beyond, the worst nodes are evicted. kUnlimited:
  // the memory limit of the run decides.
  std::size_t node_memory = kUnlimited;
  // See SearchOptions::audit.
  bool audit = false;
  // See SearchOptions::proof. Must outlive the run.
  ProofLog* proof = nullptr;
};

// The paper's policy kFixed is for cross-checks, and the published low levels are for comparison:
// both use plain CBS.
inline Techniques techniques_of(const SolveOptions& options) {
  const bool plain = options.policy == Policy::kFixed || options.low_level != LowLevel::kOwn;
  return plain ? Techniques() : options.techniques;
}

inline SearchOptions search_options_of(const SolveOptions& options) {
  return {techniques_of(options), options.seed,  options.audit,
          options.tuning,         options.proof, options.deterministic};
}

// Solves `instance` to `options.omega`, or until a limit is reached. Always returns a proven lower
// bound. `observer` (may be null) is called from any thread, one at a time. Throws what the
// observer throws, what reading the checkpoint throws (InputError), and std::logic_error or
// std::runtime_error if a part of the search fails: the checker refuses a plan, `options.start`
// included, or CBC fails.
Solution solve(const Instance& instance, const SolveOptions& options, const Limits& limits,
               RunObserver* observer = nullptr);

// The same for a problem that the caller keeps.
Solution solve(const Problem& problem, const SolveOptions& options, const Limits& limits,
               RunObserver* observer = nullptr);

// Returns the solution if no search is needed: the instance is seen to be infeasible, or a limit
// was reached before `problem` was complete. Returns nullopt if a search is needed. For engines.
std::optional<Solution> presolve(const Problem& problem, const SolveOptions& options,
                                 const Limits& limits, RunObserver& observer);

}  // namespace grove::detail
