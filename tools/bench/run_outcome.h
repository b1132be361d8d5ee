// SPDX-License-Identifier: MIT
// Evaluates finished runs of `grove solve` and of the certificate checker.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "batch/outcome.h"
#include "model/instance.h"
#include "tools/bench/child_process.h"

namespace grove::detail::bench {

// Returns the outcome of a run on `instance` that was not cancelled. `plan_file` is its plan file,
// `output_file` contains its standard output and standard error. The plan is re-checked; statements
// that the checker cannot confirm, such as the lower bound, are taken from the plan file. A failure
// of the run is an outcome, not an exception. A run that took longer than `time_limit_s` is not
// solved, even if its plan file reports no limit: the solver reads the clock only at intervals, and
// the process needs time to start and to end.
batch::Outcome outcome_of_run(const ChildEnd& end, double time_limit_s, const Instance& instance,
                              const std::filesystem::path& plan_file,
                              const std::filesystem::path& output_file);

// Returns whether the certificate checker verified the lower bound or the infeasibility in
// `outcome`. `end` and `output_file` are those of the checker. If it did not, the reason becomes
// the outcome's error unless the outcome already has one.
bool check_claims(batch::Outcome& outcome, const ChildEnd& end,
                  const std::filesystem::path& output_file);

inline constexpr const char* kTimeLimit = "time limit";  // error of a run that reached it

// Maximum number of points of a trace.
inline constexpr std::size_t kMaxTracePoints = 200;

// Returns the incumbents of a run from its JSON log (--log-format jsonl), thinned out to
// kMaxTracePoints. Skips a truncated last line. Returns none if there is no log.
std::vector<batch::TracePoint> trace_of_log(const std::filesystem::path& log);

// Returns whether grove refused its instance or its options (kExitBadInput).
bool is_refusal(const ChildEnd& end);
// Returns the reason for a refusal, without the name of the instance. `instance`: path of the
// instance on the command line.
std::string refusal(const std::filesystem::path& output_file, const std::string& instance);

// Returns ": " and the last line of `output_file`, without a leading "grove: error: "; "" if there
// is no output.
std::string last_output_line(const std::filesystem::path& output_file);

}  // namespace grove::detail::bench
