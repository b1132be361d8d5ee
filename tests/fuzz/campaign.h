// SPDX-License-Identifier: MIT
// Many random cases in a row.
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
  std::int64_t too_large = 0;   // skipped: the oracle gave up
  std::int64_t infeasible = 0;  // no plan exists
  std::int64_t unstopped = 0;   // a plan exists, and nothing was meant to stop the search ...
  std::int64_t unsolved = 0;    // ... but its patience did
  std::map<std::string, std::int64_t> by_status;
  std::map<std::string, std::int64_t> by_omega;
  std::map<std::string, std::int64_t> by_kind;   // CTS, MG, mixed
  std::map<std::string, std::int64_t> by_world;  // grid, roads; turning, work
  std::map<std::string, std::int64_t> by_trait;  // what else there is; a case may have several

  void add(const FuzzCase& fuzz_case, const CaseResult& result);
  // Of the unstopped cases. Being slow is no wrong claim; being slow often means a search that goes
  // in circles.
  double unsolved_percent() const;
  std::string summary() const;
};

// A case that fails, what is wrong with it, and the smallest one like it.
struct Failure {
  FuzzCase original;
  FuzzCase shrunk;
  CaseResult result;  // of the shrunk one

  std::string report() const;
};

struct Campaign {
  std::int64_t count = 0;                          // how many cases
  std::uint64_t seed = 0;                          // of the first; the next ones count up
  std::optional<double> seconds = std::nullopt;    // at most so long
  std::chrono::milliseconds patience = kPatience;  // see run_case()
  std::filesystem::path trace = {};  // if given, holds the case under way: for crashes
};

// Runs until the first failure, which it shrinks, or the end.
std::optional<Failure> run_campaign(const Campaign& campaign, const Solver& solver, Tally& tally);

// Shrinks a failing case.
Failure explain(const FuzzCase& fuzz_case, CaseResult first, const Solver& solver,
                std::chrono::milliseconds patience = kPatience);

}  // namespace grove::detail::fuzz
