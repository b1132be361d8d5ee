// SPDX-License-Identifier: MIT
// Outcomes of finished runs of grove.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "batch/outcome.h"
#include "model/instance.h"
#include "tools/bench/child_process.h"

namespace grove::detail::bench {

// Returns the outcome of a run that solved `instance`, with plan file `plan_file` and output
// `output_file`. From the plan file it accepts only what the checker confirms or cannot compute
// itself. Never throws because of a failure of the run; that is an outcome. Not for cancelled runs.
// A run that took longer than `time_limit_s` is not solved, even if its plan file says so: a solver
// reads the clock only at intervals, and a process takes time to start and to end.
batch::Outcome outcome_of_run(const ChildEnd& end, double time_limit_s, const Instance& instance,
                              const std::filesystem::path& plan_file,
                              const std::filesystem::path& output_file);

// Returns whether the certificate checker, with output `output_file`, verified all that the outcome
// claims. Otherwise its message becomes the outcome's error, unless there is one.
bool check_claims(batch::Outcome& outcome, const ChildEnd& end,
                  const std::filesystem::path& output_file);

inline constexpr const char* kTimeLimit = "time limit";  // as text of an error

// Maximum number of points of a trace.
inline constexpr std::size_t kMaxTracePoints = 200;

// Returns the incumbents of a run, read from its JSON log (--log-format jsonl); from a truncated
// log as many as it has, without a log none.
std::vector<batch::TracePoint> trace_of_log(const std::filesystem::path& log);

// Whether grove refused its instance or its options.
bool is_refusal(const ChildEnd& end);
// Returns why, without the name of the instance.
std::string refusal(const std::filesystem::path& output_file, const std::string& instance);

// Returns ": " and the last line of the output of grove; "" if there is no output.
std::string last_output_line(const std::filesystem::path& output_file);

}  // namespace grove::detail::bench
