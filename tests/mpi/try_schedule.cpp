// SPDX-License-Identifier: MIT
#include "tests/mpi/try_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "tests/fuzz/claims.h"
#include "tests/fuzz/fuzz_case.h"
#include "tests/fuzz/random.h"
#include "tests/mpi/random_schedule.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/primal/crowd.h"

namespace grove::testing {
namespace {

using oracle::Answer;
using oracle::Verdict;

// The truth about crowds, which are too many for exhaustive search, is what one thread proves with
// all it has.
Answer truth_by_one_thread(const Instance& instance) {
  Limits limits;
  limits.set_deadline(Limits::Clock::now() + std::chrono::milliseconds(500));
  SolveOptions options;
  options.omega = Omega();
  Solution solution = solve(instance, options, limits);
  if (solution.status != Status::kOptimal) return {};
  return {Verdict::kSolved, std::move(solution.plan)};
}

// Plain CBS makes many nodes, which is what travels. The primal search takes a millisecond a step.
void make_search_poor(SolveOptions& options, fuzz::Random& dice) {
  options.threads = 1;
  options.deterministic = false;
  if (dice.percent(20)) options.techniques = {};
  if (dice.percent(70)) options.techniques = {Technique::kTarget, Technique::kStrongBranching};
  if (dice.percent(95)) options.techniques = options.techniques.without(Technique::kPrimal);
  if (dice.percent(60)) options.omega = Omega();
}

Schedule random_schedule(std::uint64_t seed, fuzz::Random& dice) {
  Schedule schedule;
  schedule.ranks = dice.pick<int>({1, 2, 2, 3, 4, 7});
  schedule.workers = dice.between(1, 2);
  schedule.seed = seed;
  return schedule;
}

}  // namespace

std::vector<std::string> try_schedule(std::uint64_t seed, ScheduleTally& tally) {
  fuzz::Random dice(seed);
  fuzz::FuzzCase fuzz_case = fuzz::random_case(seed);
  SolveOptions& options = fuzz_case.options;
  make_search_poor(options, dice);
  const bool is_tiny = dice.percent(50);
  const Instance instance =
      is_tiny ? fuzz_case.instance.build()
              : random_crowd({.size = 7, .obstacles = 20, .agents = 5, .tasks = 5}, seed);
  const Answer truth =
      is_tiny ? oracle::solve_jointly(instance, 200'000) : truth_by_one_thread(instance);
  if (truth.verdict != Verdict::kSolved) return {};
  ++tally.tried;

  std::vector<std::string> wrong;
  const auto look = [&, optimum = truth.plan->cost](Cost lower_bound) {
    if (lower_bound > optimum && wrong.empty())
      wrong.push_back(fmt::format("lower bound {} above the optimum {}", lower_bound, optimum));
  };
  RunObserver observer;
  ScheduleCounts counts;
  const Solution solution = solve_in_random_order(instance, options, random_schedule(seed, dice),
                                                  observer, look, counts);
  const auto stop = solution.stats.texts.find("stopped_by");
  const bool gave_up = stop != solution.stats.texts.end() && stop->second == "memory limit";
  std::ranges::copy(
      fuzz::false_claims(instance, truth, options.omega, solution, !counts.ended || gave_up),
      std::back_inserter(wrong));
  tally.unfinished += !counts.ended;
  tally.messages += counts.messages;
  const auto& stats = solution.stats.counts;
  if (counts.ended) {
    tally.nodes += stats.at("nodes_expanded");
    tally.batches += stats.at("batches");
    tally.restarts += stats.at("restarts");
  }
  return wrong;
}

}  // namespace grove::testing
