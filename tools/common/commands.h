// SPDX-License-Identifier: MIT
// The subcommands of grove. Each add_*_command() registers its subcommand with `app`. CLI11 runs
// the command in a callback while it parses the command line. A command throws InputError for bad
// input, CLI::ParseError for bad usage, and CommandFailed if it has already reported the error. Any
// other exception is an internal failure. run_program() turns exceptions into exit codes.
#pragma once

#include <CLI/App.hpp>
#include <exception>

namespace grove::detail {

inline constexpr int kExitSuccess = 0;
inline constexpr int kExitInternalFailure = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitNoPlan = 3;         // no plan was found, with --require-plan
inline constexpr int kExitInterrupted = 130;  // 128 + SIGINT, as shells report Ctrl-C

// The command ends with this exit code and has already reported the reason.
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
