// SPDX-License-Identifier: MIT
// Finds a plan, and proves how good it is.
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

// Where a run stands.
struct Progress {
  double seconds = 0;  // since it began
  std::int64_t nodes_expanded = 0;
  std::int64_t nodes_open = 0;
  std::int64_t lower_bound = 0;           // proven so far
  std::optional<std::int64_t> cost = {};  // of the best plan so far
};

struct Options {
  // How far from optimal a plan may be: its cost is to be at most 1 + omega times the lower bound.
  // 0: optimal; infinity: any plan. In steps of 1e-9.
  double omega = 0;
  // Seconds, and bytes that the process may hold. When a limit strikes the best plan so far comes
  // back, with the bound proven so far. None: no limit.
  std::optional<double> time_limit = std::nullopt;
  std::optional<std::size_t> memory_limit = std::nullopt;
  // Ends the run like a limit; from any thread.
  std::stop_token stop = {};
  int threads = 1;
  // The same plan for any number of threads, limits aside.
  bool deterministic = false;
  std::uint64_t seed = 0;
  // "auto", or one of the published methods to compare with (grove solve --help lists them).
  std::string method = "auto";
  // A valid plan to begin with.
  std::optional<Plan> start = std::nullopt;
  // Told of every better plan, and where the run stands, about every `progress_interval` seconds;
  // from threads of the run, one at a time. What they throw ends the run and comes out of solve().
  std::function<void(const Plan&, const Progress&)> on_incumbent = {};
  std::function<void(const Progress&)> on_progress = {};
  double progress_interval = 0.1;
};

// Any number of solves may go on at once. Throws InvalidArgument for options that do not go
// together or with the instance, and Error.
GROVE_API Solution solve(const Instance& instance, const Options& options = {});

}  // namespace grove
