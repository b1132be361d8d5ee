// SPDX-License-Identifier: MIT
/// \file
/// Solving: options, progress and solve().
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "grove/export.hpp"
#include "grove/plan.hpp"

namespace grove {

/// Progress of a run.
struct Progress {
  double seconds = 0;                     ///< Seconds since the run started.
  std::int64_t nodes_expanded = 0;        ///< Constraint-tree nodes expanded so far.
  std::int64_t nodes_open = 0;            ///< Live constraint-tree nodes not yet expanded.
  std::int64_t lower_bound = 0;           ///< Proven so far: no plan costs less.
  std::optional<std::int64_t> cost = {};  ///< Cost of the best plan so far.
};

/// Returns the default of Options::threads: the number of cores that this process may use, at most
/// 1024.
GROVE_API int default_threads();
/// Returns the default of Options::memory_limit in bytes: 80 % of the memory of the machine or, if
/// a container or batch system sets a limit, of that limit; rounded down to a multiple of 10 MB,
/// but at least 10 MB.
GROVE_API std::size_t default_memory_limit();

/// Options of solve(). The defaults are those of `grove solve`: a plan within 1 % of optimal, or
/// the best plan found within 180 seconds, on all cores.
struct Options {
  /// Relative tolerance, from 0 to 1e6, or infinity: the run ends when the plan costs at most (1 +
  /// omega) times the lower bound. 0: an optimal plan; infinity: any plan. Rounded to a multiple of
  /// 1e-9.
  double omega = 0.01;
  /// Wall-clock seconds, >= 0. At the limit solve() returns the best plan and the lower bound so
  /// far. std::nullopt: no limit.
  std::optional<double> time_limit = 180;
  /// Limit, in bytes, on the resident memory of the process. Near the limit the search frees cached
  /// results and evicts its worst nodes, whose bound it keeps. If this is not enough, the run ends
  /// as at the time limit. std::nullopt: no limit.
  std::optional<std::size_t> memory_limit = default_memory_limit();
  /// A stop request, from any thread, ends the run like a limit.
  std::stop_token stop = {};
  int threads = default_threads();  ///< Search threads, from 1 to 1024.
  /// True: the run finds the same plan for any number of threads, unless a limit ends it.
  bool deterministic = false;
  std::uint64_t seed = 0;  ///< Seed of all random choices; any value.
  /// "auto", or the name of a published method for comparison (`grove solve --help` lists them).
  std::string method = "auto";
  /// A valid plan of the instance: the first incumbent.
  std::optional<Plan> start = std::nullopt;
  /// Called with each better plan. Threads of the run call it and on_progress, one call at a time;
  /// the thread that makes the call does not search during it. If the function throws, the run ends
  /// and solve() rethrows the exception.
  std::function<void(const Plan&, const Progress&)> on_incumbent = {};
  /// Called about every `progress_interval` seconds and at the end of the search (never if no
  /// search is needed), by the rules of on_incumbent.
  std::function<void(const Progress&)> on_progress = {};
  double progress_interval = 0.1;  ///< Seconds, >= 0.
  /// Only for Session::replan(), when agents choose which tasks they visit: weight, from 0 to 100,
  /// of the sum of the times of these visits against the cost of the plan. 0: tasks are assigned so
  /// that the agents finish early, also if one agent then makes many visits one after the other;
  /// 10: so that tasks are visited early. Does not change the cost of a plan and the lower bound.
  int visit_weight = 0;
};

/// Finds a plan and proves a lower bound on the cost of every plan. Returns when the tolerance or a
/// limit is reached, or when infeasibility is proven. Throws InvalidArgument for options that are
/// invalid, contradict each other or do not suit the instance; what the callbacks in `options`
/// throw; and Error. Thread-safe. Several runs may use the same instance at the same time.
GROVE_API Solution solve(const Instance& instance, const Options& options = {});

}  // namespace grove
