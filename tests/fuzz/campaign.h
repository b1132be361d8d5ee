// SPDX-License-Identifier: MIT
// Runs random fuzz cases until one fails or a limit is reached.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "model/limits.h"
#include "tests/fuzz/run_case.h"

namespace grove::detail::fuzz {

struct Tally {
  std::int64_t passed = 0;
  std::int64_t failed = 0;
  std::int64_t too_large = 0;   // skipped: too many joint states for the oracle
  std::int64_t infeasible = 0;  // no plan exists
  std::int64_t unstopped = 0;   // a plan exists, and the case has ImposedLimit::kNothing
  std::int64_t unsolved = 0;    // those of `unstopped` that the patience or node memory ended
  std::map<std::string, std::int64_t> by_status;
  std::map<std::string, std::int64_t> by_omega;
  std::map<std::string, std::int64_t> by_kind;   // MAPF, CTS, MG, mixed
  std::map<std::string, std::int64_t> by_world;  // grid, roads; turning, work
  std::map<std::string, std::int64_t> by_trait;  // further properties; a case can have several

  void add(const FuzzCase& fuzz_case, const CaseResult& result);
  // Percentage of `unstopped` cases that are `unsolved`; 0 if there are no such cases. A slow run
  // makes no wrong claim, but many slow runs indicate that the search makes no progress.
  double unsolved_percent() const;
  std::string summary() const;
};

// A failing case, and the case to which it was shrunk.
struct Failure {
  FuzzCase original;
  FuzzCase shrunk;
  CaseResult result;  // of `shrunk`; of `original` if `shrunk` does not fail again

  std::string report() const;
};

struct Campaign {
  std::int64_t count = 0;  // number of cases
  std::uint64_t seed = 0;  // of the first case; it increases by 1 for each further case
  std::optional<double> seconds = std::nullopt;    // time limit; nullopt: none
  std::chrono::milliseconds patience = kPatience;  // see run_case()
  // File to which each case is written before it runs, in case of a crash. It holds only the latest
  // case. Empty: none.
  std::filesystem::path trace = {};
  int choices_percent = 0;  // of the cases have choices
};

// Runs cases until one fails, and shrinks that case. Returns nullopt if no case failed within the
// limits. Adds the results to `tally`.
std::optional<Failure> run_campaign(const Campaign& campaign, const Solver& solver, Tally& tally);

// Shrinks a failing case, for about one minute at most. `first`: its result.
Failure explain(const FuzzCase& fuzz_case, CaseResult first, const Solver& solver,
                std::chrono::milliseconds patience = kPatience);

}  // namespace grove::detail::fuzz
