// SPDX-License-Identifier: MIT
#include "tests/mpi/try_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "engine/checkpoint.h"
#include "model/fingerprint.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/fuzz_case.h"
#include "tests/fuzz/random.h"
#include "tests/mpi/random_schedule.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/primal/crowd.h"
#include "tests/support/clocks.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail::testing {
namespace {

using oracle::Answer;
using oracle::Verdict;

// Returns the optimum of a dense instance that is too large for exhaustive search, if a
// single-threaded run with all techniques proves it; else Verdict::kTooLarge.
Answer truth_by_one_thread(const Instance& instance) {
  const ClockReadingLimit limits(20'000);
  SolveOptions options;
  options.omega = Omega();
  Solution solution = solve(instance, options, limits);
  if (solution.status != Status::kOptimal) return {};
  return {Verdict::kSolved, std::move(solution.plan)};
}

// Chooses weak techniques, so that the search generates and transfers many nodes. Bounds on pairs
// reduce the number of nodes, but they lead to messages with learned bounds. The primal search is
// mostly off, because each of its steps takes a millisecond.
void choose_weak_techniques(Techniques& techniques, fuzz::Random& dice) {
  if (dice.percent(20)) techniques = {};
  if (dice.percent(70)) techniques = {Technique::kTarget, Technique::kStrongBranching};
  if (dice.percent(25)) techniques = {Technique::kWdg, Technique::kJointMdd, Technique::kClusters};
  if (dice.percent(95)) techniques = techniques.without(Technique::kPrimal);
}

Schedule random_schedule(Techniques techniques, fuzz::Random& dice) {
  Schedule schedule;
  if (techniques.has(Technique::kPrimal))
    schedule.max_turns /= 10;  // a primal step takes a millisecond
  if (dice.percent(15)) schedule.limit_rate = dice.pick<int>({10, 100});
  schedule.ranks = dice.pick<int>({1, 2, 2, 3, 4, 5, 7, 8});
  schedule.workers = dice.between(1, 2);
  schedule.seed = static_cast<std::uint64_t>(dice.below(1 << 30));
  return schedule;
}

Policy policy_of(const SolveOptions& options) {
  return options.policy == Policy::kFixed ? Policy::kFixed : Policy::kFree;
}

// Requests checkpoints at random times, tests the claims of a single process that resumes from
// them, and kills all ranks, so that a different number of ranks must resume from the last
// checkpoint.
class CheckpointTester : public RunObserver {
 public:
  CheckpointTester(const Instance& instance, const Answer& truth, SolveOptions& options,
                   fuzz::Random& dice, const std::filesystem::path& folder)
      : instance_(instance),
        truth_(truth),
        options_(options),
        dice_(dice),
        used_(dice.percent(50)),
        once_in_(dice.pick<int>({30, 300, 1000})) {
    if (used_) options.checkpoints = {folder, 1e9, &asked_};
  }

  void on_checkpoint(const CheckpointReport& report) override {
    if (!report.failure.empty()) throw std::runtime_error(report.failure);
    is_there_ = true;
    if (reopened_ < kMaxReopened && dice_.percent(60)) reopen();
    if (dice_.percent(50)) kill_in_ = dice_.pick<int>({1, 20, 1000});
  }

  bool kills() {
    if (used_ && asks_left_ > 0 && dice_.below(once_in_) == 0) {
      asked_ = true;
      --asks_left_;
    }
    killing_ = kills_left_ > 0 && kill_in_ > 0 && --kill_in_ == 0;
    return killing_;
  }
  // Returns whether it has killed all ranks since the previous call.
  bool has_killed() {
    if (killing_) --kills_left_;
    return std::exchange(killing_, false);
  }
  std::unique_ptr<CheckpointReader> checkpoint() const {
    if (!is_there_) return nullptr;
    return std::make_unique<CheckpointReader>(options_.checkpoints.directory,
                                              fingerprint(instance_), policy_of(options_));
  }
  // Returns whether checkpoints are enabled and none was written. Call after the end of a run.
  bool misses_one() const { return used_ && !is_there_; }
  int reopened() const { return reopened_; }
  const std::vector<std::string>& wrong() const { return wrong_; }

 private:
  static constexpr int kMaxReopened = 8;

  // Solves from the checkpoint in a single process. The primal search is off, because it could find
  // the optimum even if its node is missing from the checkpoint.
  void reopen() {
    ++reopened_;
    const ClockReadingLimit limits(1'000);
    SolveOptions options;
    options.omega = Omega();
    options.policy = options_.policy;
    options.rtsp = options_.rtsp;
    options.techniques = Techniques::defaults().without(Technique::kPrimal);
    const auto reader = checkpoint();
    options.resume = reader.get();
    const Solution solution = solve(instance_, options, limits);
    for (const std::string& what :
         fuzz::false_claims(instance_, truth_, options.omega, solution, true))
      wrong_.push_back("from a checkpoint: " + what);
  }

  const Instance& instance_;
  const Answer& truth_;
  const SolveOptions& options_;
  fuzz::Random& dice_;
  const bool used_;
  const int once_in_;  // mean number of steps between requests
  std::atomic<bool> asked_{false};
  bool is_there_ = false;
  bool killing_ = false;
  int kill_in_ = 0;  // steps; 0: do not kill
  int kills_left_ = 3;
  int asks_left_ = 30;
  int reopened_ = 0;
  std::vector<std::string> wrong_;
};

}  // namespace

std::vector<std::string> try_schedule(std::uint64_t seed, ScheduleTally& tally) {
  fuzz::Random dice(seed);
  fuzz::FuzzCase fuzz_case = fuzz::random_case(seed);
  SolveOptions& options = fuzz_case.options;
  options.low_level = LowLevel::kOwn;  // other low levels are slow and do not affect the protocol
  options.threads = 1;
  options.deterministic = false;
  choose_weak_techniques(options.techniques, dice);
  if (dice.percent(60)) options.omega = Omega();
  if (dice.percent(40)) {
    options.techniques = options.techniques.with(Technique::kJointSearch);
    options.tuning.joint_start_work = 0;
    options.tuning.joint_step_work = 1;
  }
  if (dice.percent(70)) {
    options.techniques = options.techniques.with(Technique::kLagrangian);
    options.tuning.lagrangian_min_agents = 1;
    options.tuning.lagrangian_start_work = 0;
    options.tuning.lagrangian_step_work = 1;
    options.tuning.lagrangian_min_remote_work = 1;
    options.tuning.lagrangian_max_share = dice.pick<double>({2, 50});
    options.tuning.lagrangian_level = dice.pick<double>({0.02, 0.2});
  }
  options.tuning.coordinator_children = std::array{2, 3, 2, 64}[seed % 4];
  options.tuning.bound_broadcast_rate = std::array{8.0, 0.01, 0.0}[seed % 3];
  if (dice.percent(20)) options.policy = Policy::kFixed;
  if (dice.percent(30)) options.node_memory = dice.pick<std::size_t>({500, 2000, 5000});
  const bool is_tiny = dice.percent(50);
  const Instance instance =
      is_tiny ? fuzz_case.instance.build()
              : random_crowd({.size = 7, .obstacles = 20, .agents = 5, .tasks = 5}, seed);
  const Answer truth =
      is_tiny ? oracle::solve_jointly(instance, 200'000) : truth_by_one_thread(instance);
  if (truth.verdict != Verdict::kSolved) return {};
  ++tally.tried;

  const TemporaryDirectory folder;
  CheckpointTester tester(instance, truth, options, dice, folder.path());
  std::vector<std::string> wrong;
  const auto look = [&, optimum = truth.plan->cost](Cost lower_bound) {
    if (lower_bound > optimum && wrong.empty())
      wrong.push_back(fmt::format("lower bound {} above the optimum {}", lower_bound, optimum));
    return tester.kills();
  };
  ScheduleCounts counts;
  Solution solution;
  do {
    const auto checkpoint = tester.checkpoint();
    options.resume = checkpoint.get();
    tally.resumed += checkpoint != nullptr;
    counts = {};
    solution = solve_in_random_order(instance, options, random_schedule(options.techniques, dice),
                                     tester, look, counts);
    options.seed = static_cast<std::uint64_t>(dice.below(1000));
    choose_weak_techniques(options.techniques, dice);
  } while (tester.has_killed());
  const auto stop = solution.stats.texts.find("stopped_by");
  const bool out_of_memory = stop != solution.stats.texts.end() && stop->second == "memory limit";
  const bool stopped = !counts.ended || counts.limit_reached || out_of_memory;
  std::ranges::copy(fuzz::false_claims(instance, truth, options.omega, solution, stopped),
                    std::back_inserter(wrong));
  std::ranges::copy(tester.wrong(), std::back_inserter(wrong));
  if (counts.stuck) wrong.emplace_back("deadlock: all ranks wait for each other");
  if (counts.left_messages) wrong.emplace_back("messages were not received");
  if (counts.ended && !counts.limit_reached && tester.misses_one())
    wrong.emplace_back("no checkpoint");
  tally.unfinished += !counts.ended;
  tally.limit_reached += counts.limit_reached;
  tally.reopened += tester.reopened();
  tally.messages += counts.messages;
  const auto& stats = solution.stats.counts;
  if (counts.ended) {
    tally.nodes += stats.at("nodes_expanded");
    tally.batches += stats.at("node_batches");
    tally.restarts += stats.at("restarts");
    tally.learned_bounds += stats.at("learned_bounds_sent");
    if (stats.contains("remote_pricings")) tally.remote_pricings += stats.at("remote_pricings");
  }
  return wrong;
}

}  // namespace grove::detail::testing
