// SPDX-License-Identifier: MIT
// What to make of a run that has ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "batch/outcome.h"
#include "model/instance.h"
#include "tools/bench/child_process.h"

namespace grove::detail::bench {

// The outcome of a solve of `instance` that was to write `plan_file` and said what is in the file
// `said`: believes the plan file nothing that the checker can work out itself. Never throws for
// what the run did wrong: that is an outcome. Not for runs that were cancelled.
// A run that took longer than `time_limit_s` is not solved, though it may think so: it looks at the
// clock now and then, and a process takes some time to begin and to end.
batch::Outcome outcome_of_run(const ChildEnd& end, double time_limit_s, const Instance& instance,
                              const std::filesystem::path& plan_file,
                              const std::filesystem::path& said);

// Has the checker of certificates, which said what is in the file `said`, verified all that the
// outcome claims? What it says else becomes the outcome's error, if it has none.
bool is_verified(batch::Outcome& outcome, const ChildEnd& end, const std::filesystem::path& said);

inline constexpr const char* kTimeLimit = "time limit";  // as an error

// So many are kept.
inline constexpr std::size_t kMostTracePoints = 200;

// The plans that a run had on the way, from its log for programs (--log-format jsonl). A log that
// is not there, or cut off, tells what it tells.
std::vector<batch::TracePoint> trace_of_log(const std::filesystem::path& log);

// Whether grove refused its instance or its options.
bool is_refusal(const ChildEnd& end);
// Why, without the name of the instance, which the reader knows.
std::string refusal(const std::filesystem::path& said, const std::string& instance);

// The last line that grove said, after a colon and a blank; empty if it said nothing.
std::string last_words(const std::filesystem::path& said);

}  // namespace grove::detail::bench
