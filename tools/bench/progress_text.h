// SPDX-License-Identifier: MIT
// Progress line and summary table of a benchmark.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "batch/false_claims.h"
#include "batch/progress.h"
#include "batch/row.h"

namespace grove::detail::bench {

// Counts over the runs of one method.
struct MethodCount {
  int runs = 0;
  int solved = 0;
  int errors = 0;
  int wrong = 0;                        // runs with an invalid plan
  int claimed = 0;                      // runs of solvers that report a plan but wrote none
  int unsupported = 0;                  // instances that the method refuses; not in `runs`
  std::vector<double> runtimes_s = {};  // Row::runtime_s() of each of `runs`

  void count(const batch::Row& row);
};

// Snapshot of the progress of a benchmark. Runs whose rows already existed count as done.
struct BenchState {
  std::vector<std::string> methods;           // names, in the order of the command line
  std::map<std::string, MethodCount> counts;  // by name; contains all of `methods`
  batch::Workload work = {};
  double elapsed_s = 0;                              // since this command started
  std::set<std::string> other_versions = {};         // other Grove versions in existing rows
  std::vector<batch::FalseClaim> false_claims = {};  // set when the benchmark ends

  void count(const batch::Row& row);
};

// Returns the progress line:
// "41/135 done; 2:05 elapsed, about 4:10 left; solved: cts-cbs-a 20/21, auto 20/20; 1 error".
batch::ProgressText progress_text(const BenchState& state);

// Returns a table with a line per method (solved and total runs, median runtime, errors, and
// further counts that are not 0 for all methods), a legend, and the first false claims.
std::string summary_table(const BenchState& state);

}  // namespace grove::detail::bench
