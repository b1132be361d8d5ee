// SPDX-License-Identifier: MIT
// What surrounds a solve: its files, the log and its head, the facts of the run, its end.
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

// Finds out before the search whether the files of a run can be written and are not each other;
// gives the plan file its default name. Until what it returns is gone, no other run may write them.
// Throws InputError.
[[nodiscard]] std::vector<OutputLock> prepare_outputs(SolveArguments& arguments,
                                                      const LoadedInstance& loaded);

// The log that was asked for, on the screen and in its file. `may_show_progress`: see LogSink.
// Throws InputError.
std::unique_ptr<LogFormat> open_log(const SolveArguments& arguments, bool may_show_progress = true);

// The rows of a run that began at `start`.
RunLog rows_of(LogFormat& log, const SolveArguments& arguments,
               std::chrono::steady_clock::time_point start);

// `workers`: who works, "2" threads or "4 ranks of 2".
LogHead head_of(const CLI::App& app, const SolveArguments& arguments, const LoadedInstance& loaded,
                const std::string& workers);

// What the plan file is to say of the run that began at `start`.
void add_run_facts(Solution& solution, const CLI::App& app, const SolveArguments& arguments,
                   std::chrono::steady_clock::time_point start);

// Writes the plan file and the end of the log, and says on stderr what must not be missed; see
// plan_output.h. Returns why the plan could not be written, on a full disk for instance; empty: it
// was. The log then still has its summary.
[[nodiscard]] std::string finish_run(const SolveArguments& arguments, const Instance& instance,
                                     const Solution& solution, LogFormat& log);
// Says on stderr what could not be written at the end of a run, each that is not empty, and throws
// CommandFailed (exit code 1) if there is any.
void report_failures(const std::vector<std::string>& failures);

}  // namespace grove::detail
