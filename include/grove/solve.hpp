// SPDX-License-Identifier: MIT
/// \file
/// Finds a plan, and proves how good it is.
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

/// Where a run stands.
struct Progress {
  double seconds = 0;                     ///< Since it began.
  std::int64_t nodes_expanded = 0;        ///< Of constraint trees.
  std::int64_t nodes_open = 0;            ///< Nodes that wait.
  std::int64_t lower_bound = 0;           ///< Proven so far.
  std::optional<std::int64_t> cost = {};  ///< Of the best plan so far.
};

/// Threads for all cores that this process may use, at most 1024: the default of Options::threads.
GROVE_API int default_threads();
/// 80 % of the memory of the machine, or of what a container or batch system grants, in bytes: the
/// default of Options::memory_limit.
GROVE_API std::size_t default_memory_limit();

/// How solve() goes about it. The defaults are those of `grove solve`: a plan within 1 % of
/// optimal, or the best plan of 180 seconds, on all cores.
struct Options {
  /// How far from optimal a plan may be: its cost is to be at most 1 + omega times the lower bound.
  /// 0: optimal; infinity: any plan. In steps of 1e-9.
  double omega = 0.01;
  /// Seconds, from 0. When it is over the best plan so far comes back, with the bound proven so
  /// far. None: no limit.
  std::optional<double> time_limit = 180;
  /// Bytes that the process may hold. Near it the search forgets what can be found again, then
  /// gives up its worst nodes, whose bound still counts; if that does not help it ends like the
  /// time limit. None: no limit.
  std::optional<std::size_t> memory_limit = default_memory_limit();
  /// Ends the run like a limit; from any thread.
  std::stop_token stop = {};
  int threads = default_threads();  ///< That search: from 1 to 1024.
  /// The same plan for any number of threads, limits aside.
  bool deterministic = false;
  std::uint64_t seed = 0;  ///< Of what is left to chance; any will do.
  /// "auto", or one of the published methods to compare with (`grove solve --help` lists them).
  std::string method = "auto";
  /// A valid plan to begin with.
  std::optional<Plan> start = std::nullopt;
  /// Told of every better plan. Called from threads of the run, one call at a time, on_progress
  /// included; the search of that thread waits meanwhile. What it throws ends the run and comes out
  /// of solve().
  std::function<void(const Plan&, const Progress&)> on_incumbent = {};
  /// Told where the run stands, about every `progress_interval` seconds and at the end; called as
  /// on_incumbent is.
  std::function<void(const Progress&)> on_progress = {};
  double progress_interval = 0.1;  ///< Seconds, from 0.
};

/// Finds a plan, and proves how good it is; returns when that is done or a limit strikes. Any
/// number of solves may go on at once, on one instance, too. Throws InvalidArgument for options
/// that do not go together or with the instance, what a function of the options throws, and Error.
GROVE_API Solution solve(const Instance& instance, const Options& options = {});

}  // namespace grove
