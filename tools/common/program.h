// SPDX-License-Identifier: MIT
// Common parts of all programs: help, error messages, exit codes.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

namespace grove::detail {

// Prints one line on standard error: "grove: error: ...".
void print_error(const CLI::App& app, const std::string& message);

// If an option with one value is given several times, the last one counts, as with compilers, so
// that a user can override the options of a script. Call it before options and subcommands are
// added.
void let_last_option_win(CLI::App& app);

// Sets the help layout and the version option that all programs have. Call it before subcommands
// are added, because they inherit both.
void prepare_program(CLI::App& app);

// Parses the command line, which runs the commands, and turns what they throw into an exit code
// (commands.h). Errors, help and version are printed only if `speaks`; of several processes with
// the same output, one should print. `refused` is called with the reason if the command does not
// run, or ends early. Internal failures propagate.
int run_program(
    CLI::App& app, int argc, char** argv, bool speaks = true,
    const std::function<void(const std::string& why)>& refused = [](const std::string&) {});

// Runs a program of a single process: run_program(), and reports internal failures as well.
int run_only_process(CLI::App& app, int argc, char** argv);

}  // namespace grove::detail
