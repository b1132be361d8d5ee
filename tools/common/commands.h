// SPDX-License-Identifier: MIT
// The subcommands of grove. Each function adds one to `app`; the command runs as its callback while
// the command line is parsed. Commands throw InputError for bad input, CLI::ParseError for bad
// usage, and CommandFailed if they have printed the error themselves. Any other exception is an
// internal failure. program.h turns exceptions into exit codes.
#pragma once

#include <CLI/App.hpp>
#include <exception>

namespace grove::detail {

inline constexpr int kExitSuccess = 0;
inline constexpr int kExitInternalFailure = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitNoPlan = 3;         // although a plan was required
inline constexpr int kExitInterrupted = 130;  // by Ctrl-C, as shells report it

class CommandFailed : public std::exception {
 public:
  explicit CommandFailed(int exit_code) : exit_code_(exit_code) {}
  int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

void add_solve_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_execute_command(CLI::App& app);
void add_generate_command(CLI::App& app);
void add_replan_command(CLI::App& app);
void add_helper_commands(CLI::App& app);
void add_convert_command(CLI::App& app);
void add_bench_command(CLI::App& app);
void add_proof_command(CLI::App& app);

}  // namespace grove::detail
