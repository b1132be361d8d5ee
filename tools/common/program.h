// SPDX-License-Identifier: MIT
// What the programs have in common: help, complaints, exit codes.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

namespace grove::detail {

// One line on stderr: "grove: error: ...".
void complain(const CLI::App& app, const std::string& message);

// Of an option with one value that is given several times, the last one counts, as with compilers:
// a script's own options can so be overruled. To be called before options and subcommands are
// added.
void let_last_option_count(CLI::App& app);

// Gives `app` the layout of help and the version that all programs have. Before its subcommands are
// added, which take it over.
void prepare_program(CLI::App& app);

// Parses the command line, which runs the commands, and turns what they throw into an exit code
// (commands.h). Complaints, help and version are printed only if it `speaks`: of several processes
// that say the same, one should. `refused` is told first why nothing is done, or no more. Internal
// failures go through.
int run_program(
    CLI::App& app, int argc, char** argv, bool speaks = true,
    const std::function<void(const std::string& why)>& refused = [](const std::string&) {});

// The whole of a program that is one process: run_program(), and internal failures are told too.
int run_only_process(CLI::App& app, int argc, char** argv);

}  // namespace grove::detail
