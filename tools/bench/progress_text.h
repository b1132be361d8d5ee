// SPDX-License-Identifier: MIT
// Progress and summary of a benchmark as text.
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
  int claimed = 0;                      // runs that claim a plan but wrote none
  int unsuitable = 0;                   // instances outside the method's class; not in `runs`
  std::vector<double> runtimes_s = {};  // the time limit for runs that are not solved

  void count(const batch::Row& row);
};

// A benchmark at one moment. Runs of earlier commands count as done.
struct BenchState {
  std::vector<std::string> methods;           // in the order of the command line
  std::map<std::string, MethodCount> counts;  // of all methods
  batch::Workload work = {};
  double elapsed_s = 0;                              // since this command started
  std::set<std::string> other_versions = {};         // other Grove versions among existing rows
  std::vector<batch::FalseClaim> false_claims = {};  // filled when the benchmark ends

  void count(const batch::Row& row);
};

// "41/135 done; 2:05 elapsed, about 4:10 left; solved: cts-cbs-a 20/21, auto 20/20; 1 error"
batch::ProgressText progress_text(const BenchState& state);

// A line per method: solved and total runs, median runtime, errors, and further counts that are not
// 0. Then a legend, and the false claims (only the first of many).
std::string summary_table(const BenchState& state);

}  // namespace grove::detail::bench
