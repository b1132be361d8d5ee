// SPDX-License-Identifier: MIT
// What surrounds a solve: the head of the log, the files, the facts of the run.
#pragma once

#include <CLI/App.hpp>
#include <chrono>
#include <string>

#include "grove/io/instance_file.h"
#include "grove/model/plan.h"
#include "tools/solve/run_log.h"
#include "tools/solve/solve_arguments.h"

namespace grove {

// Finds out before the search whether the files of a run can be written and are not each other;
// gives the plan file its default name. Throws InputError.
void prepare_outputs(SolveArguments& arguments, const LoadedInstance& loaded);

// `workers`: who works, "2" threads or "4 ranks of 2".
void log_head(LogSink& sink, const CLI::App& app, const SolveArguments& arguments,
              const LoadedInstance& loaded, const std::string& workers);

// That the run goes on from there.
void log_resumed(LogSink& sink, const CheckpointHeader& checkpoint);

// What the plan file is to say of the run that began at `start`.
void add_run_facts(Solution& solution, const CLI::App& app, const SolveArguments& arguments,
                   std::chrono::steady_clock::time_point start);

}  // namespace grove
