// SPDX-License-Identifier: MIT
// How far a bench is, in words.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "batch/false_claims.h"
#include "batch/progress.h"
#include "batch/row.h"

namespace grove::detail::bench {

// What has become of a method's runs.
struct MethodCount {
  int runs = 0;
  int solved = 0;
  int errors = 0;
  int wrong = 0;                        // plans that are none
  int claimed = 0;                      // without a plan
  int unsuitable = 0;                   // instances that the method is not for; not among the runs
  std::vector<double> runtimes_s = {};  // of those not solved the time limit

  void count(const batch::Row& row);
};

// A bench at one moment. Runs of earlier commands count as done.
struct BenchState {
  std::vector<std::string> methods;           // in the order of the command line
  std::map<std::string, MethodCount> counts;  // of all of them
  batch::Workload work = {};
  double elapsed_s = 0;                              // since this command began
  std::set<std::string> other_versions = {};         // of the program, that made rows which stand
  std::vector<batch::FalseClaim> false_claims = {};  // known when it has ended

  void count(const batch::Row& row);
};

// "41/135 done; 2:05 gone, about 4:10 left; solved: cts-cbs-a 20/21, auto 20/20; 1 error"
batch::ProgressText progress_text(const BenchState& state);

// A line for each method: solved of those run, the median runtime, errors, and what else there is;
// then what that means, and the false claims, the first of many.
std::string summary_table(const BenchState& state);

}  // namespace grove::detail::bench
