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
struct Problem;          // planning/problem.h

// The part of the agents' sequences that a tree of the forest fixes.
enum class Policy : std::uint8_t {
  kAuto,   // the engine's choice: kFree
  kFixed,  // one complete joint task sequence (with choices: joint route) per tree: the paper's
           // CTS-CBS
  kFree,   // one tree for all sequences; the low level chooses the order
};

struct SolveOptions {
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  Omega omega;
  Policy policy = Policy::kAuto;
  RtspBackend rtsp = RtspBackend::kAuto;  // used only with kFixed
  // Must be kOwn with kFixed. Any low level other than kOwn implies plain CBS, without techniques.
  LowLevel low_level = LowLevel::kOwn;
  int threads = 1;  // at least 1
  // The run depends neither on the number of threads nor on the clock: it finds the same plan and
  // reports the same events for any number of threads, unless a limit is reached.
  bool deterministic = false;
  // Breaks ties among conflicts at the same time, and seeds the primal search. With one thread or
  // `deterministic`, the same seed gives the same run, unless a limit is reached.
  std::uint64_t seed = 0;
  // Not used with kFixed or a low level other than kOwn; see techniques_of().
  Techniques techniques = Techniques::defaults();
  Tuning tuning = {};
  static constexpr int kMaxVisitWeight = 100;
  // From 0 to kMaxVisitWeight: weight of the times of visits by choice in re-planning; see
  // objective() in assigned_search.h.
  int visit_weight = 0;
  std::optional<Plan> start = std::nullopt;  // the first incumbent, a valid plan
  Checkpoints checkpoints = {};
  // Checkpoint of an earlier run of the same instance and policy, to resume from; nullptr: none.
  // solve() reads it; the caller owns it.
  CheckpointReader* resume = nullptr;
  // Maximum size of open nodes and their ancestors, in bytes; above it the worst nodes are evicted.
  // kUnlimited: only the memory limit of the run applies.
  std::size_t node_memory = kUnlimited;
  // Whether expanded nodes are audited; see SearchOptions::audit.
  bool audit = false;
  // Proof log, or nullptr for none; see SearchOptions::proof. Must outlive the run.
  ProofLog* proof = nullptr;
};

// Returns the techniques that a run uses: none, that is plain CBS, with policy kFixed (for
// cross-checks with the paper) or a published low level (for comparison).
inline Techniques techniques_of(const SolveOptions& options) {
  const bool plain = options.policy == Policy::kFixed || options.low_level != LowLevel::kOwn;
  return plain ? Techniques() : options.techniques;
}

inline SearchOptions search_options_of(const SolveOptions& options) {
  return {techniques_of(options), options.seed,  options.audit,
          options.tuning,         options.proof, options.deterministic};
}

// Solves `instance` to within `options.omega`, or until a limit is reached. Always returns a proven
// lower bound. Any thread can call `observer` (or nullptr), one call at a time. Throws what the
// observer throws, what reading the checkpoint throws (InputError), and std::logic_error or
// std::runtime_error if a part of the search fails, that is, if the checker refuses a plan
// (including `options.start`) or CBC fails.
Solution solve(const Instance& instance, const SolveOptions& options, const Limits& limits,
               RunObserver* observer = nullptr);

// Solves an instance whose Problem the caller keeps; otherwise like the overload above.
Solution solve(const Problem& problem, const SolveOptions& options, const Limits& limits,
               RunObserver* observer = nullptr);

// Returns the solution if no search is needed because the instance is found infeasible, or because
// a limit was reached before `problem` was complete. Returns nullopt if a search is needed. For
// engines.
std::optional<Solution> presolve(const Problem& problem, const SolveOptions& options,
                                 const Limits& limits, RunObserver& observer);

}  // namespace grove::detail
