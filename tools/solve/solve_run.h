// SPDX-License-Identifier: MIT
// Everything around a solve: its files, its log, data of the run in the plan file, its end.
#pragma once

#include <CLI/App.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "io/file_lock.h"
#include "io/instance_file.h"
#include "model/plan.h"
#include "tools/solve/log_format.h"
#include "tools/solve/run_log.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// Checks before the search that the files of a run can be written and are distinct; gives the plan
// file its default name. No other run may write these files while the returned locks exist. Throws
// InputError.
[[nodiscard]] std::vector<OutputLock> prepare_outputs(SolveArguments& arguments,
                                                      const LoadedInstance& loaded);

// Opens the log on the screen and in its file, in the requested format. `may_show_progress`: see
// LogSink. Throws InputError.
std::unique_ptr<LogFormat> open_log(const SolveArguments& arguments, bool may_show_progress = true);

// Returns the observer that writes rows of a run that started at `start`.
RunLog rows_of(LogFormat& log, const SolveArguments& arguments,
               std::chrono::steady_clock::time_point start);

// `workers`: "2" threads or "4 ranks of 2".
LogHead head_of(const CLI::App& app, const SolveArguments& arguments, const LoadedInstance& loaded,
                const std::string& workers);

// Adds data of the run that started at `start` to the statistics in the plan file.
void add_run_facts(Solution& solution, const CLI::App& app, const SolveArguments& arguments,
                   std::chrono::steady_clock::time_point start);

// Writes the plan file and the end of the log, and important results on standard error; see
// plan_output.h. Returns "", or the reason why the plan could not be written, for instance a full
// disk. The log has its summary even then.
[[nodiscard]] std::string finish_run(const SolveArguments& arguments, const Instance& instance,
                                     const Solution& solution, LogFormat& log);
// Prints each failure that is not "" on standard error. Throws CommandFailed (exit code 1) if there
// is any.
void report_failures(const std::vector<std::string>& failures);

}  // namespace grove::detail
