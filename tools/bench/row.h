// SPDX-License-Identifier: MIT
// What is kept of one run of a method on an instance: a row of the table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "grove/model/omega.h"

namespace grove::bench {

// What makes a run the run it is: the same twice should end the same.
struct RunIdentity {
  std::string instance;  // batch::Entry::id
  std::string method;
  std::string options;  // of grove solve, but for the following
  std::int64_t seed = 0;
  double time_limit_s = 0;
  std::optional<double> memory_limit_gb = {};  // none: what the machine allows
  std::string digest;                          // batch::Entry::digest

  friend bool operator==(const RunIdentity&, const RunIdentity&) = default;
};

// What one can say of an instance before it is solved.
struct InstanceFacts {
  std::string map;                            // the file's name without .map
  std::optional<std::int64_t> scenario = {};  // as its name says
  std::int64_t agents = 0;
  std::int64_t tasks = 0;
  std::string problem;  // cts, mg, mapf, mixed

  friend bool operator==(const InstanceFacts&, const InstanceFacts&) = default;
};

// How a run ended.
struct Outcome {
  std::string status = "error";  // or a plan file's
  bool solved = false;           // ended by itself with a plan that was re-checked
  std::optional<Cost> cost = {};
  std::optional<Cost> lower_bound = {};
  std::optional<std::int64_t> roots = {};
  std::optional<std::int64_t> rtsp_calls = {};
  std::optional<std::int64_t> nodes = {};
  std::optional<std::int64_t> low_level_calls = {};
  std::optional<double> peak_memory_mb = {};
  std::string omega = {};  // 0, 0.01, inf
  std::string version = {};
  std::string error = {};  // why the status is error, or the limit that struck

  bool failed() const { return status == "error"; }
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

struct Row {
  RunIdentity run;
  InstanceFacts instance;
  std::int64_t threads = 1;
  Outcome outcome = {};
  std::optional<Cost> root_cost = {};  // sum_of_best_sequences() of the instance
  double wall_s = 0;                   // files keep microseconds
  std::string machine;
  std::string ended_at;  // UTC, as 2026-11-30T23:59:59Z

  // The paper counts a run that solved nothing with its limit.
  double runtime_s() const { return outcome.solved ? wall_s : run.time_limit_s; }

  friend bool operator==(const Row&, const Row&) = default;
};

// One line of JSON without its end. Text that is no UTF-8 is mended.
std::string json_line(const Row& row);
// Reads such a line. Throws std::invalid_argument saying what is wrong with it.
Row parse_json_line(std::string_view line);

// The same as CSV, see batch/csv.h; what is absent is empty.
std::string csv_header();
std::string csv_line(const Row& row);

}  // namespace grove::bench
