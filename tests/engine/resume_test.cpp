// SPDX-License-Identifier: MIT
// Searches that are stopped and resumed from their checkpoints reach the same optimum.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>

#include "engine/checkpoint.h"
#include "engine/run_observer.h"
#include "engine/solve.h"
#include "model/check.h"
#include "model/fingerprint.h"
#include "tests/primal/crowd.h"
#include "tests/support/clocks.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace resume_test {

using testing::random_crowd;

SolveOptions plain() {
  SolveOptions options;
  options.omega = Omega();
  options.techniques = {Technique::kStrongBranching};
  return options;
}

// Interrupts the run after a given number of expansions. Requests a checkpoint every seven
// expansions.
class Interrupter : public RunObserver {
 public:
  explicit Interrupter(std::int64_t after) : left_(after) {}

  void on_expanded(const NodePtr&, const Expansion&, int) override {
    if (--left_ == 0) interrupted = true;
    if (left_ % 7 == 0) requested = true;
  }
  void on_checkpoint(const CheckpointReport& report) override {
    EXPECT_EQ(report.failure, "");
    ++written;
  }

  std::atomic<bool> interrupted{false};
  std::atomic<bool> requested{false};  // requests a checkpoint
  int written = 0;

 private:
  std::int64_t left_;
};

Solution solve_for(const Instance& instance, const SolveOptions& options,
                   Interrupter& interrupter) {
  testing::HangLimit limits;
  limits.watch_interrupt(&interrupter.interrupted);
  return solve(instance, options, limits, &interrupter);
}

// Runs for `expansions` expansions, resuming from the checkpoint in `folder` if there is one.
Solution resume_for(const Instance& instance, SolveOptions options,
                    const std::filesystem::path& folder, std::int64_t expansions) {
  std::unique_ptr<CheckpointReader> reader;
  if (std::filesystem::exists(checkpoint_file(folder))) {
    const Policy policy = options.policy == Policy::kFixed ? Policy::kFixed : Policy::kFree;
    reader = std::make_unique<CheckpointReader>(folder, fingerprint(instance), policy);
    options.resume = reader.get();
  }
  Interrupter interrupter(expansions);
  options.checkpoints = {folder, 1e9, &interrupter.requested};
  Solution solution = solve_for(instance, options, interrupter);
  EXPECT_GT(interrupter.written, 0);
  return solution;
}

// Stops and resumes a search repeatedly, each time with a different number of threads, and expects
// that the bound never falls and the optimum is the same. Skips instances that 200 expansions do
// not solve.
void expect_same_optimum(const Instance& instance, SolveOptions options, int& resumed) {
  Interrupter enough(200);
  const Solution truth = solve_for(instance, options, enough);
  if (truth.status != Status::kOptimal) return;
  const TemporaryDirectory folder;
  Cost bound = 0;
  for (int run = 0;; ++run) {
    ASSERT_LT(run, 1000);
    options.threads = 1 + run % 3;
    options.seed = static_cast<std::uint64_t>(run);
    const Solution solution = resume_for(instance, options, folder.path(), 2 << (run / 4));
    EXPECT_GE(solution.lower_bound, bound);
    EXPECT_LE(solution.lower_bound, truth.plan->cost);
    bound = solution.lower_bound;
    if (solution.status != Status::kOptimal) continue;
    EXPECT_EQ(solution.plan->cost, truth.plan->cost);
    EXPECT_TRUE(check(instance, solution).empty());
    resumed += run;
    return;
  }
}

TEST(Resume, FindsTheSameOptimum) {
  int resumed = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed)
    expect_same_optimum(random_crowd({.size = 8, .obstacles = 20, .agents = 6, .tasks = 8}, seed),
                        plain(), resumed);
  EXPECT_GT(resumed, 10) << "too easy to be a test";
}

TEST(Resume, RestoresTheTreesOfTheFixedPolicy) {
  SolveOptions options = plain();
  options.policy = Policy::kFixed;
  int resumed = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    expect_same_optimum(random_crowd({.size = 7, .obstacles = 20, .agents = 5, .tasks = 8}, seed),
                        options, resumed);
  EXPECT_GT(resumed, 5) << "too easy to be a test";
}

TEST(Resume, KeepsTheBoundOfEvictedNodes) {
  SolveOptions options = plain();
  options.node_memory = 4000;
  int resumed = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed)
    expect_same_optimum(random_crowd({.size = 8, .obstacles = 20, .agents = 5, .tasks = 6}, seed),
                        options, resumed);
  EXPECT_GT(resumed, 5) << "too easy to be a test";
}

TEST(Resume, FinishedRunEndsAtOnceButContinuesForASmallerOmega) {
  const Instance instance = random_crowd({.size = 8, .obstacles = 20, .agents = 6, .tasks = 8}, 3);
  const TemporaryDirectory folder;
  SolveOptions options = plain();
  options.omega = Omega::parse("0.5");
  const Solution first = resume_for(instance, options, folder.path(), 1 << 30);
  ASSERT_TRUE(first.plan);
  const Solution again = resume_for(instance, options, folder.path(), 1 << 30);
  EXPECT_EQ(again.plan->cost, first.plan->cost);
  EXPECT_EQ(again.stats.counts.at("nodes_expanded"), 0);
  options.omega = Omega();
  const Solution exact = resume_for(instance, options, folder.path(), 1 << 30);
  EXPECT_EQ(exact.status, Status::kOptimal);
  EXPECT_LE(exact.plan->cost, first.plan->cost);
}

TEST(Resume, ReportsTheProvenBoundWithoutTimeToSearch) {
  const Instance instance = random_crowd({.size = 8, .obstacles = 20, .agents = 6, .tasks = 8}, 3);
  const TemporaryDirectory folder;
  const Solution first = resume_for(instance, plain(), folder.path(), 20);
  ASSERT_GT(first.lower_bound, 0);
  CheckpointReader reader(folder.path(), fingerprint(instance), Policy::kFree);
  SolveOptions options = plain();
  options.resume = &reader;
  Limits limits;
  limits.set_deadline(testing::kPast);
  const Solution none = solve(instance, options, limits);
  EXPECT_EQ(none.lower_bound, first.lower_bound);
  EXPECT_EQ(none.plan.has_value(), first.plan.has_value());
}

}  // namespace resume_test
}  // namespace grove::detail
