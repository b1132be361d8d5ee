// SPDX-License-Identifier: MIT
#include "tests/mpi/try_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "grove/engine/checkpoint.h"
#include "grove/model/fingerprint.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/fuzz_case.h"
#include "tests/fuzz/random.h"
#include "tests/mpi/random_schedule.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/primal/crowd.h"
#include "tests/support/temporary_directory.h"

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

Schedule random_schedule(fuzz::Random& dice) {
  Schedule schedule;
  schedule.ranks = dice.pick<int>({1, 2, 2, 3, 4, 7});
  schedule.workers = dice.between(1, 2);
  schedule.seed = static_cast<std::uint64_t>(dice.below(1 << 30));
  return schedule;
}

// Asks for checkpoints now and then, and once one has been written may kill all, so that others, of
// another number, must go on from there.
class Asker : public RunObserver {
 public:
  Asker(SolveOptions& options, fuzz::Random& dice, const std::filesystem::path& folder)
      : options_(options), dice_(dice), used_(dice.percent(40)) {
    if (used_) options.checkpoints = {folder, 1e9, &asked_};
  }

  void on_checkpoint(const CheckpointReport& report) override {
    if (!report.failure.empty()) throw std::runtime_error(report.failure);
    is_there_ = true;
    killing_ = kills_left_ > 0 && dice_.percent(50);
  }

  bool kills() {
    if (used_ && dice_.below(300) == 0) asked_ = true;
    return killing_;
  }
  // Has it killed all since it was last asked?
  bool has_killed() {
    if (killing_) --kills_left_;
    return std::exchange(killing_, false);
  }
  std::unique_ptr<CheckpointReader> checkpoint(const Instance& instance) const {
    if (!is_there_) return nullptr;
    const Policy policy = options_.policy == Policy::kFixed ? Policy::kFixed : Policy::kFree;
    return std::make_unique<CheckpointReader>(options_.checkpoints.directory, fingerprint(instance),
                                              policy);
  }

 private:
  const SolveOptions& options_;
  fuzz::Random& dice_;
  const bool used_;
  std::atomic<bool> asked_{false};
  bool is_there_ = false;
  bool killing_ = false;
  int kills_left_ = 3;
};

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

  const TemporaryDirectory folder;
  Asker asker(options, dice, folder.path());
  std::vector<std::string> wrong;
  const auto look = [&, optimum = truth.plan->cost](Cost lower_bound) {
    if (lower_bound > optimum && wrong.empty())
      wrong.push_back(fmt::format("lower bound {} above the optimum {}", lower_bound, optimum));
    return asker.kills();
  };
  ScheduleCounts counts;
  Solution solution;
  do {
    const auto checkpoint = asker.checkpoint(instance);
    options.resume = checkpoint.get();
    tally.resumed += checkpoint != nullptr;
    counts = {};
    solution = solve_in_random_order(instance, options, random_schedule(dice), asker, look, counts);
  } while (asker.has_killed());
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
