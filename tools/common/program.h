// SPDX-License-Identifier: MIT
// Code that all programs share: help, error messages, exit codes.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

namespace grove::detail {

// Prints `message` as one line on standard error: "NAME: error: ...", where NAME is the program.
void print_error(const CLI::App& app, const std::string& message);

// Makes the last value count if a single-value option is given several times, as in compilers, so
// that a user can override the options of a script. Call it before adding options and subcommands.
void let_last_option_win(CLI::App& app);

// Sets what all programs have in common: help layout, --version, a required subcommand,
// let_last_option_win(), and SIGXFSZ ignored. Call it before adding subcommands, because they
// inherit the settings.
void prepare_program(CLI::App& app);

// Parses the command line, which runs the command. Turns its exceptions into an exit code
// (commands.h), except that exceptions for internal failures propagate. Prints errors, help and the
// version only if `prints_messages`; in an MPI run only one process should print. Calls `refused`
// with the reason if bad usage, bad input, or a request for help or the version ended the program.
int run_program(
    CLI::App& app, int argc, char** argv, bool prints_messages = true,
    const std::function<void(const std::string& why)>& refused = [](const std::string&) {});

// Like run_program(), for a program with a single process. Also reports internal failures and
// returns kExitInternalFailure for them.
int run_only_process(CLI::App& app, int argc, char** argv);

}  // namespace grove::detail
