// SPDX-License-Identifier: MIT
// Runs of external solvers: their input files, command lines and output files. Nothing that a
// solver reports is trusted: plans are re-checked and their costs recomputed; all other statements
// are stored as claims.
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
  std::string program;  // {program}
};

// One run of an external solver.
class ExternalRun {
 public:
  // Writes the input files of the solver into `folder`, which belongs to this run and is emptied
  // first. Throws NotRepresentable if the solver's format cannot express this instance, and
  // InputError if files cannot be written. `loaded` is the instance of `entry`; all arguments must
  // outlive this object.
  ExternalRun(const ExternalSolver& solver, const batch::Entry& entry, const LoadedInstance& loaded,
              const batch::Settings& settings, std::filesystem::path folder);

  std::vector<std::string> command() const;
  // Whether the command line contains the time limit, so that the solver may end by itself then.
  bool receives_time_limit() const;
  // Returns the outcome of a run that ended and was not cancelled. `output_file`: its output.
  batch::Outcome outcome_of_run(const ChildEnd& end, const std::filesystem::path& output_file);
  // The plan that it wrote, if it passed the check.
  const std::optional<Solution>& valid_plan() const { return valid_plan_; }
  // The file for the plan, which may not exist.
  std::filesystem::path plan() const;

 private:
  std::string value_of(std::string_view placeholder) const;
  std::string expand(const std::string& text) const;
  void write_input(const batch::Entry& entry);
  void write_moving_ai();
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
  std::string options;  // for the table: without paths of programs
  ExternalSolver solver;
};

// Parses the values "NAME=COMMAND" of --solver:
//   eecbs=/opt/eecbs --suboptimality 1.1       the adapter NAME, its program, further options
//   fast=eecbs:/opt/eecbs --suboptimality 2    an adapter under another name
//   mine=my.json:/opt/mine                     an adapter of the user
//   mine=/opt/mine {instance} {output}         a command with placeholders
// `claims` are "NAME=REGEX": where such a solver prints its cost. Throws CLI::ValidationError, and
// InputError if the file of an adapter is wrong.
std::vector<NamedSolver> read_solver_arguments(const std::vector<std::string>& solvers,
                                               const std::vector<std::string>& claims);

// Returns the names of the adapters that Grove ships.
std::vector<std::string> known_adapters();

}  // namespace grove::detail::bench
