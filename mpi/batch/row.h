// SPDX-License-Identifier: MIT
// What is kept of one instance's solve: a row of the table of results.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "grove/model/plan.h"

namespace grove::batch {

// The options that results depend on, by name as one types them: {"omega", "0.01"}. All of them,
// defaults too, so that two runs can be compared. Not what the machine decides: ranks and threads
// have columns of their own.
using Settings = std::map<std::string, std::string>;

// What whoever solves an instance says of it.
struct Result {
  Status status = Status::kUnknown;
  std::optional<Cost> cost = {};         // of the plan, if there is one
  std::optional<Cost> lower_bound = {};  // proven; none when infeasible
  std::int64_t nodes_expanded = 0;
  std::optional<double> first_plan_s = {};  // when the first plan was found; none: not known
  std::string stopped_by = {};              // the limit that struck; empty: none did
  std::string plan_file = {};  // relative to the folder of the table; empty: there is none

  // The user ended the run: not a result to keep, the instance is to be solved again.
  bool interrupted() const { return stopped_by == "interrupt"; }

  friend bool operator==(const Result&, const Result&) = default;
};

// `solution` as a result; `plan_file` is where it was written.
Result result_of(const Solution& solution, std::string plan_file);

struct Row {
  std::string id;        // Entry::id
  std::string instance;  // Entry::path, of the run that solved it
  std::string digest;    // Entry::digest
  Result result;
  std::string error;  // why there is no result; empty: there is one
  std::string version;
  int ranks = 1;           // that solved it together
  int threads = 1;         // of each
  double wall_s = 0;       // files keep microseconds
  std::string started_at;  // UTC, as 2026-11-30T23:59:59Z

  bool failed() const { return !error.empty(); }
  // "error", or the result's status.
  std::string_view status_text() const;

  friend bool operator==(const Row&, const Row&) = default;
};

// (cost - lower bound) / lower bound, so it compares with omega; infinite over a bound of 0; none
// without a cost or a bound.
std::optional<double> gap(const Result& result);

// One line of JSON without its end. Text that is no UTF-8 is mended.
std::string json_line(const Row& row, const Settings& settings);
// Reads such a line. Throws std::invalid_argument saying what is wrong with it.
struct RowAndSettings {
  Row row;
  Settings settings;
};
RowAndSettings parse_json_line(std::string_view line);

// The same as CSV (RFC 4180, but lines end in LF), with a column for each setting.
std::string csv_header(const Settings& settings);
std::string csv_line(const Row& row, const Settings& settings);

}  // namespace grove::batch
