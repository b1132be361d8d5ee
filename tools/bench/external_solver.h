// SPDX-License-Identifier: MIT
// A program of someone else on the bench: what it is called with, and what is made of what it
// leaves behind. Nothing that it says is believed: plans are re-checked and their costs counted
// anew; the rest is kept as claims.
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

// One run of it.
class ExternalRun {
 public:
  // Writes what the solver reads into `folder`, which is its own and made anew. Throws
  // NotRepresentable where it cannot be given this instance, InputError where files cannot be
  // written. `loaded` is the instance of `entry`; all must outlive this.
  ExternalRun(const ExternalSolver& solver, const batch::Entry& entry, const LoadedInstance& loaded,
              const batch::Settings& settings, std::filesystem::path folder);

  std::vector<std::string> command() const;
  // Whether it is told of the time limit, and so may end by itself when that strikes.
  bool knows_the_limit() const;
  // The outcome of a run that has ended and was not cancelled; it said what is in the file `said`.
  batch::Outcome outcome_of_run(const ChildEnd& end, const std::filesystem::path& said);
  // The plan that it wrote and that was found to be one.
  const std::optional<Solution>& shown() const { return shown_; }
  // The file in which it wrote one, perhaps.
  std::filesystem::path plan() const;

 private:
  std::string value_of(std::string_view placeholder) const;
  std::string told(const std::string& text) const;
  void write_input(const batch::Entry& entry);
  void write_moving_ai();
  void read_claims(batch::Outcome& outcome, const std::filesystem::path& said) const;
  void read_trace(batch::Outcome& outcome, const std::filesystem::path& said) const;
  void read_plan(batch::Outcome& outcome, const ChildEnd& end);
  void finish_with_plan(batch::Outcome& outcome, const ChildEnd& end,
                        const std::filesystem::path& said) const;
  void finish_without_plan(batch::Outcome& outcome, const ChildEnd& end,
                           const std::filesystem::path& said) const;
  std::optional<std::string> last_match(const LinePattern& pattern,
                                        const std::filesystem::path& said) const;
  std::optional<double> number_of(const std::optional<LinePattern>& pattern,
                                  const std::filesystem::path& said) const;

  const ExternalSolver& solver_;
  const LoadedInstance& loaded_;
  const Instance told_;
  const batch::Settings& settings_;
  const std::filesystem::path folder_;
  std::filesystem::path map_;
  std::filesystem::path scenario_;
  std::filesystem::path instance_;
  std::optional<Solution> shown_;
};

struct NamedSolver {
  std::string name;
  std::string options;  // for the table: without where programs lie
  ExternalSolver solver;
};

// Reads "NAME=COMMAND" of the command line:
//   eecbs=/opt/eecbs --suboptimality 1.1       the adapter of that name, its program, more words
//   fast=eecbs:/opt/eecbs --suboptimality 2    an adapter under another name
//   mine=my.json:/opt/mine                     one of one's own
//   mine=/opt/mine {instance} {output}         a command with places for what it is given
// `claims` are "NAME=REGEX": where such a solver prints its cost. Throws CLI::ValidationError, and
// InputError where an adapter's file is wrong.
std::vector<NamedSolver> read_solver_arguments(const std::vector<std::string>& solvers,
                                               const std::vector<std::string>& claims);

// The names of the adapters that Grove brings.
std::vector<std::string> known_adapters();

}  // namespace grove::detail::bench
