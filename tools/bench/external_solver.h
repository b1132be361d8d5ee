// SPDX-License-Identifier: MIT
// Runs of external solvers: writes their input files, builds their command lines and reads their
// output files. Plans are re-checked and their costs recomputed. Everything else that a solver
// reports is stored as an unverified claim.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/entry.h"
#include "batch/row.h"
#include "io/solver_file.h"
#include "tools/bench/child_process.h"

namespace grove::detail::bench {

struct ExternalSolver {
  SolverAdapter adapter;
  std::string program;  // path; value of the placeholder {program}
};

// One run of an external solver.
class ExternalRun {
 public:
  // Empties `folder`, which only this run uses, and writes the input files of the solver into it.
  // `loaded` is the instance of `entry`. `solver`, `loaded` and `settings` must outlive this
  // object. Throws NotRepresentable if the solver's format cannot express the instance, and
  // InputError if a file cannot be written.
  ExternalRun(const ExternalSolver& solver, const batch::Entry& entry, const LoadedInstance& loaded,
              const batch::Settings& settings, std::filesystem::path folder);

  // Returns the command line.
  std::vector<std::string> command() const;
  // Returns whether the command line contains the time limit, so that the solver can end by itself
  // at the limit.
  bool receives_time_limit() const;
  // Returns the outcome of a run that has ended and was not cancelled. `output_file` contains its
  // standard output and standard error.
  batch::Outcome outcome_of_run(const ChildEnd& end, const std::filesystem::path& output_file);
  // The solver's plan if outcome_of_run() has found it valid; otherwise nullopt.
  const std::optional<Solution>& valid_plan() const { return valid_plan_; }
  // Returns the path of the solver's plan file, which may not exist; "" if the solver writes none.
  std::filesystem::path plan() const;

 private:
  std::string value_of(std::string_view placeholder) const;
  std::string expand(const std::string& text) const;
  void write_input(const batch::Entry& entry);
  void write_map_and_scenario();
  void read_claims(batch::Outcome& outcome, const std::filesystem::path& output_file) const;
  void read_trace(batch::Outcome& outcome, const std::filesystem::path& output_file) const;
  void read_plan(batch::Outcome& outcome, const ChildEnd& end);
  void finish_with_plan(batch::Outcome& outcome, const ChildEnd& end,
                        const std::filesystem::path& output_file) const;
  void finish_without_plan(batch::Outcome& outcome, const ChildEnd& end,
                           const std::filesystem::path& output_file) const;
  std::optional<std::string> last_match(const LinePattern& pattern,
                                        const std::filesystem::path& output_file) const;
  std::optional<double> number_of(const std::optional<LinePattern>& pattern,
                                  const std::filesystem::path& output_file) const;

  const ExternalSolver& solver_;
  const LoadedInstance& loaded_;
  const Instance solver_instance_;
  const batch::Settings& settings_;
  const std::filesystem::path folder_;
  std::filesystem::path map_;
  std::filesystem::path scenario_;
  std::filesystem::path instance_;
  std::optional<Solution> valid_plan_;
};

struct NamedSolver {
  std::string name;
  std::string options;  // for the table; does not contain the path of the program
  ExternalSolver solver;
};

// Parses the values "NAME=COMMAND" of --solver. COMMAND has one of these forms:
//   eecbs=/opt/eecbs --suboptimality 1.1       program and further options for the adapter NAME
//   fast=eecbs:/opt/eecbs --suboptimality 2    an adapter with a different name
//   mine=my.json:/opt/mine                     an adapter file of the user
//   mine=/opt/mine {instance} {output}         a command with placeholders, without adapter
// Each of `claims` is "NAME=REGEX": solver NAME prints the cost that it claims as group 1 of REGEX
// in the last line that matches. Throws CLI::ValidationError for bad values and InputError for a
// bad adapter file.
std::vector<NamedSolver> read_solver_arguments(const std::vector<std::string>& solvers,
                                               const std::vector<std::string>& claims);

// Returns the names of the adapters that are shipped with Grove, in ascending order.
std::vector<std::string> known_adapters();

}  // namespace grove::detail::bench
