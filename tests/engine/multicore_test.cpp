// SPDX-License-Identifier: MIT
// Several threads on one search find the same optimum as one thread; with `deterministic` the whole
// run is the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/run_observer.h"
#include "engine/solve.h"
#include "model/check.h"
#include "tests/fuzz/tiny_instance.h"
#include "tests/primal/crowd.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace multicore_test {

using testing::ClockReadingLimit;
using testing::Crowd;
using testing::HangLimit;
using testing::random_crowd;

// Instances that are not solved at the root but are easy: plain CBS expands a few hundred nodes.
std::vector<Instance> instances() {
  std::vector<Instance> all;
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    all.push_back(random_crowd({.size = 8, .obstacles = 20, .agents = 6, .tasks = 8}, seed));
  return all;
}

SolveOptions plain(int threads) {
  SolveOptions options;
  options.omega = Omega();
  options.threads = threads;
  options.techniques = {Technique::kPrimal, Technique::kStrongBranching};
  return options;
}

// Records all events of a run, without times.
class Recorder : public RunObserver {
 public:
  using Row = std::tuple<RunEvent, std::int64_t, std::int64_t, Cost, Cost>;

  void on_event(RunEvent event, const Progress& p) override {
    rows.emplace_back(event, p.nodes_expanded, p.nodes_open, p.lower_bound,
                      p.incumbent.value_or(-1));
  }

  std::vector<Row> rows;
};

TEST(Multicore, FindsTheOptimumOfOneThread) {
  std::int64_t nodes = 0;
  for (const Instance& instance : instances()) {
    const Solution single = solve(instance, plain(1), HangLimit());
    ASSERT_EQ(single.status, Status::kOptimal);
    for (const int threads : {2, 3, 8}) {
      const Solution parallel = solve(instance, plain(threads), HangLimit());
      ASSERT_EQ(parallel.status, Status::kOptimal);
      EXPECT_EQ(parallel.lower_bound, single.lower_bound);
      EXPECT_TRUE(check(instance, parallel).empty());
      nodes += parallel.stats.counts.at("nodes_expanded");
    }
  }
  EXPECT_GT(nodes, 500) << "too easy to be a test";
}

TEST(Multicore, DeterministicRunIsTheSameForAnyNumberOfThreads) {
  std::size_t longest = 0;  // number of rows of the longest log
  for (const Instance& instance : instances()) {
    std::vector<Recorder::Row> rows;
    std::vector<Path> paths;
    std::int64_t labels = 0;
    for (const int threads : {1, 2, 4, 7}) {
      SolveOptions options = plain(threads);
      options.deterministic = true;
      Recorder recorder;
      const Solution solution = solve(instance, options, HangLimit(), &recorder);
      ASSERT_EQ(solution.status, Status::kOptimal);
      std::vector<Path> found;
      for (const AgentPlan& agent : solution.plan->agents) found.push_back(agent.path);
      if (threads == 1) {
        rows = recorder.rows;
        paths = found;
        labels = solution.stats.counts.at("low_level_expanded");
      }
      ASSERT_EQ(recorder.rows, rows) << threads << " threads";
      EXPECT_EQ(found, paths);
      EXPECT_EQ(solution.stats.counts.at("low_level_expanded"), labels) << threads << " threads";
    }
    longest = std::max(longest, rows.size());
  }
  EXPECT_GT(longest, 10) << "too easy to be a test";
}

// Each expander caches its own results. In this instance one worker gets several work items in a
// round, and the label count depends on which expander executes which item.
TEST(Multicore, DeterministicRunExpandsTheSameLabelsForAnyThreads) {
  fuzz::TinyInstance tiny;
  tiny.rows = {"....", "..@.", "@@.."};
  tiny.agents = {{.start = {2, 2}, .goal = Position{0, 0}},
                 {.start = {3, 1}, .goal = {}},
                 {.start = {1, 0}, .goal = {}, .work = 1}};
  tiny.tasks = {{.cell = {3, 1}, .agents = {2}},
                {.cell = {1, 0}, .agents = {2}, .duration = 1},
                {.cell = {3, 0}, .agents = {2}}};
  const Instance instance = tiny.build();
  SolveOptions options;
  options.omega = Omega();
  options.deterministic = true;
  options.techniques = options.techniques.without(
      Techniques{Technique::kJointSearch, Technique::kJointGroups, Technique::kLagrangian});
  const auto labels = [&](int threads) {
    options.threads = threads;
    return solve(instance, options, HangLimit()).stats.counts.at("low_level_expanded");
  };
  const std::int64_t single = labels(1);
  for (const int threads : {2, 3, 4}) EXPECT_EQ(labels(threads), single) << threads << " threads";
}

// The primal search receives Lagrangian multipliers during the run.
TEST(Multicore, DeterministicRunWithLagrangianLnsIsRepeatable) {
  int with_effect = 0;
  std::vector<Instance> some = instances();
  some.erase(some.begin() + 5, some.end());
  for (const Instance& instance : some) {
    SolveOptions options = plain(1);
    options.deterministic = true;
    options.tuning.lagrangian_min_agents = 1;
    options.tuning.lagrangian_start_work = 0;
    options.tuning.lagrangian_step_work = 20;
    options.tuning.first_dual_solution_round = 1;
    options.tuning.lagrangian_lns_max_gap = 10;
    options.tuning.primal_max_share_initial = 1;
    using Counts = std::pair<std::int64_t, std::int64_t>;
    const auto counts = [&](int threads, Techniques techniques) {
      options.threads = threads;
      options.techniques = techniques;
      Solution solution = solve(instance, options, HangLimit());
      EXPECT_EQ(solution.status, Status::kOptimal);
      auto& all = solution.stats.counts;
      return Counts{all["lagrangian_rounds"], all["primal_low_level_expanded"]};
    };
    const Techniques without = options.techniques.with(Technique::kLagrangian);
    const Techniques with = without.with(Technique::kLagrangianLns);
    const auto one = counts(1, with);
    EXPECT_EQ(counts(3, with), one);
    with_effect += counts(1, without) != one;
  }
  EXPECT_GT(with_effect, 0);
}

TEST(Multicore, EventsAreSerializedAndTheBoundNeverFalls) {
  class Watcher : public RunObserver {
   public:
    void on_event(RunEvent event, const Progress& progress) override {
      EXPECT_FALSE(inside_.exchange(true));
      EXPECT_FALSE(ended_);
      ended_ = event == RunEvent::kEnd;
      if (event == RunEvent::kBound) {
        EXPECT_GT(progress.lower_bound, bound_);
        bound_ = progress.lower_bound;
      }
      if (event == RunEvent::kIncumbent) {
        EXPECT_LT(*progress.incumbent, incumbent_);
        incumbent_ = *progress.incumbent;
      }
      inside_ = false;
    }
    bool ended() const { return ended_; }

   private:
    std::atomic<bool> inside_{false};
    bool ended_ = false;
    Cost bound_ = -1;
    Cost incumbent_ = kInfiniteCost;
  };
  for (const Instance& instance : instances()) {
    Watcher watcher;
    solve(instance, plain(4), HangLimit(), &watcher);
    EXPECT_TRUE(watcher.ended());
  }
}

// If a single thread ignored the limit, the run would not end.
TEST(Multicore, LimitsEndEveryThread) {
  const Instance hard = random_crowd({.size = 16, .obstacles = 25, .agents = 40, .tasks = 60}, 1);
  for (const bool deterministic : {false, true}) {
    SolveOptions options = plain(4);
    options.deterministic = deterministic;
    const testing::ClockReadingLimit limits(20'000);
    const Solution solution = solve(hard, options, limits);
    EXPECT_EQ(limits.reason(), StopReason::kTime);
    EXPECT_EQ(solution.stats.texts.at("stopped_by"), "time limit");
    if (solution.plan) {
      EXPECT_LE(solution.lower_bound, solution.plan->cost);
    }
  }
}

TEST(Multicore, ExceptionOfAnObserverPropagates) {
  class Thrower : public RunObserver {
    void on_expanded(const NodePtr&, const Expansion&, int) override {
      throw std::runtime_error("disk full");
    }
  };
  for (const bool deterministic : {false, true}) {
    SolveOptions options = plain(3);
    options.deterministic = deterministic;
    Thrower thrower;
    EXPECT_THROW(solve(instances()[0], options, HangLimit(), &thrower), std::runtime_error);
  }
}

}  // namespace multicore_test
}  // namespace grove::detail
