// SPDX-License-Identifier: MIT
// grove-fuzz: compares the solver with the oracle on random tiny instances. Exit codes: 0 no
// failure; 1 a wrong answer, or more slow runs than allowed; 2 bad usage.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/method.h"
#include "tests/fuzz/campaign.h"
#include "tests/fuzz/planted_optimum.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {
namespace {

constexpr int kWrong = 1;
constexpr int kBadUsage = 2;

FuzzCase read_case(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return FuzzCase::parse(text.str());
}

// Solves `instance` with Grove. Throws std::logic_error if PlantedOptimum finds an error, for
// instance that the search loses the optimal plan of `truth`.
Solution solve_watched(const Instance& instance, const SolveOptions& options, const Limits& limits,
                       const oracle::Answer& truth) {
  if (instance.has_choices()) return solve_by(Method::kAuto, false, instance, options, limits);
  if (!truth.plan) return solve(instance, options, limits);
  PlantedOptimum planted(instance, *truth.plan);
  Solution solution = solve(instance, options, limits, &planted);
  if (!planted.complaints().empty()) throw std::logic_error(planted.complaints().front());
  return solution;
}

std::optional<Failure> run_files(const std::vector<std::string>& paths,
                                 std::chrono::milliseconds patience, Tally& tally) {
  for (const std::string& path : paths) {
    const FuzzCase fuzz_case = read_case(path);
    const CaseResult result = run_case(fuzz_case, solve_watched, patience);
    tally.add(fuzz_case, result);
    if (result.complaints.empty()) continue;
    fmt::print("{}\n", path);
    return explain(fuzz_case, result, solve_watched, patience);
  }
  return std::nullopt;
}

int run(const std::vector<std::string>& paths, const Campaign& campaign, double max_unsolved) {
  const auto begin = std::chrono::steady_clock::now();
  Tally tally;
  const auto failure = paths.empty() ? run_campaign(campaign, solve_watched, tally)
                                     : run_files(paths, campaign.patience, tally);
  if (failure) fmt::print("{}\n", failure->report());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  fmt::print("{:.1f} s\n{}", seconds.count(), tally.summary());
  const bool slow = tally.unsolved_percent() > max_unsolved;
  if (slow) fmt::print("more than {} % not solved in time\n", max_unsolved);
  return failure || slow ? kWrong : 0;
}

int main_of(int argc, char** argv) {
  Campaign campaign{.count = 1000};
  std::vector<std::string> paths;
  CLI::App app("Solves random tiny instances and compares every answer with an exhaustive search.");
  app.add_option("--count", campaign.count, "number of instances")->capture_default_str();
  app.add_option("--seed", campaign.seed, "seed of the first instance")->capture_default_str();
  app.add_option("--seconds", campaign.seconds, "time limit");
  double patience = 2;
  app.add_option("--patience", patience, "time limit in seconds of a run without another limit")
      ->capture_default_str();
  double max_unsolved = 100;
  app.add_option("--max-unsolved", max_unsolved,
                 "fail if a larger percentage of these runs takes longer")
      ->capture_default_str();
  campaign.choices_percent = 50;
  app.add_option("--choices", campaign.choices_percent, "percentage of instances with choices")
      ->capture_default_str();
  app.add_option("--trace", campaign.trace, "write each case to this file before it runs");
  app.add_option("--case", paths, "run the cases in these files instead")->check(CLI::ExistingFile);
  try {
    app.parse(argc, argv);
    campaign.patience = std::chrono::milliseconds(std::llround(patience * 1000));
    return run(paths, campaign, max_unsolved);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadUsage;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kBadUsage;
  }
}

}  // namespace
}  // namespace grove::detail::fuzz

int main(int argc, char** argv) {
  return grove::detail::fuzz::main_of(argc, argv);
}
