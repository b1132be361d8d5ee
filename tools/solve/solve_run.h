// SPDX-License-Identifier: MIT
// Steps before and after a search: output files, log, data of the run in the plan file, failures.
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

// Sets the default name of the plan file, checks that no output file is another output file or an
// input file (except that the plan file may be the start plan), locks the output files, and checks
// that the plan and the incumbents can be written. Removes the incumbents of an earlier run. While
// the returned locks exist, no other run of Grove can write the files; see OutputLock. Throws
// InputError.
[[nodiscard]] std::vector<OutputLock> prepare_outputs(SolveArguments& arguments,
                                                      const LoadedInstance& loaded);

// Opens the log in the requested format, on the screen and in its file. `may_show_progress`: see
// LogSink. Throws InputError if the file cannot be opened, and CLI::ValidationError if --log-tree
// is given with the text format.
std::unique_ptr<LogFormat> open_log(const SolveArguments& arguments, bool may_show_progress = true);

// Returns the observer that writes the rows of a run that started at `start`. `log` must outlive
// it.
RunLog rows_of(LogFormat& log, const SolveArguments& arguments,
               std::chrono::steady_clock::time_point start);

// Returns the head of the log. `workers`: see LogHead.
LogHead head_of(const CLI::App& app, const SolveArguments& arguments, const LoadedInstance& loaded,
                const std::string& workers);

// Adds times, memory, options and version of a run that started at `start` to the statistics in
// `solution`, which write_plan() stores.
void add_run_facts(Solution& solution, const CLI::App& app, const SolveArguments& arguments,
                   std::chrono::steady_clock::time_point start);

// Writes the plan file and the end of the log, and reports a missing plan on standard error; see
// plan_output.h. Returns "", or why the plan file could not be written, for instance a full disk;
// the log then still gets its summary.
[[nodiscard]] std::string finish_run(const SolveArguments& arguments, const Instance& instance,
                                     const Solution& solution, LogFormat& log);
// Prints each failure that is not "" on standard error. If any exists, throws CommandFailed with
// exit code 1.
void report_failures(const std::vector<std::string>& failures);

}  // namespace grove::detail
