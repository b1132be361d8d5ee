// SPDX-License-Identifier: MIT
// Tests which work items a worker chooses and when their results become visible to other workers.
#include "engine/worker.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "small_search.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace worker_test {

using Job = Worker::WorkItem::Job;

// A search with workers that the test advances step by step.
struct Search : testing::SmallSearch {
  explicit Search(Techniques techniques, Instance the_instance = testing::two_in_a_bay())
      : SmallSearch(std::move(the_instance)) {
    options.omega = Omega();
    options.techniques = techniques;
    bounds.nodes = source.nodes = &nodes;
    nodes.push(root);
  }

  Worker worker(int number = 0) { return Worker(problem, options, limits, shared, stops, number); }
  static std::optional<Job> job_of(const std::optional<Worker::WorkItem>& item) {
    return item ? std::optional(item->job) : std::nullopt;
  }

  SolveOptions options;
  testing::ScriptedBounds bounds;
  testing::CountingSource source;
  testing::CountingObserver observer;
  SharedSearch shared{options, limits, nodes, bounds, source, observer};
};

std::int64_t count(const Worker& worker, const std::string& name) {
  Stats stats;
  worker.add_counts(stats);
  return stats.counts.at(name);
}

Instance large_dense_instance() {
  return testing::random_crowd({.size = 12, .obstacles = 15, .agents = 16, .tasks = 16}, 1);
}

TEST(Worker, WorkItemIsVisibleToOthersOnceCommitted) {
  Search s({});
  Worker worker = s.worker();
  auto item = worker.choose();
  ASSERT_EQ(Search::job_of(item), Job::kExpand);
  EXPECT_EQ(item->node, s.root);
  worker.perform(*item, worker.expander());
  Worker::publish(*item);
  EXPECT_EQ(item->expansion.children.size(), 2u);
  EXPECT_EQ(s.nodes.frontier.live(), 1u) << "the root, taken";
  EXPECT_EQ(s.observer.expansions, 0);
  worker.commit(*item);
  EXPECT_EQ(s.nodes.frontier.open(), 2u);
  EXPECT_EQ(s.observer.expansions, 1);
  EXPECT_EQ(s.observer.work_items, 1);
}

// The effort of an item is its number of labels, plus 16 per call of the low level, plus a quarter
// of the node's cost, plus 1. whole_work() also counts the other expensive operations.
TEST(Worker, CountsTheWorkOfAnItem) {
  Search s({Technique::kStrongBranching, Technique::kWdg, Technique::kJointMdd});
  Worker worker = s.worker();
  for (int i = 0; i < 3; ++i) {
    auto item = worker.choose();
    ASSERT_EQ(Search::job_of(item), Job::kExpand);
    const ExpansionCounts before = worker.expander().counts();
    worker.perform(*item, worker.expander());
    const ExpansionCounts after = worker.expander().counts();
    EXPECT_EQ(item->work, after.low_level_expanded - before.low_level_expanded +
                              16 * (after.low_level_calls - before.low_level_calls) +
                              item->node->cost() / 4 + 1);
    worker.commit(*item);
  }
  const ExpansionCounts c = worker.expander().counts();
  EXPECT_GT(c.low_level_calls, 0);
  EXPECT_GT(c.joint_mdd_nodes, 0);
  EXPECT_EQ(count(worker, "low_level_calls"), c.low_level_calls);
  const std::int64_t work = c.low_level_expanded + 16 * c.low_level_calls;
  const auto times = [](double rate, std::int64_t of) { return rate * static_cast<double>(of); };
  EXPECT_DOUBLE_EQ(worker.expander().whole_work(),
                   times(1, work) + times(0.55, c.mdd_nodes) + times(0.85, c.joint_mdd_nodes) +
                       times(2, c.subproblems) + times(1.7, c.groups) + times(0.15, c.path_steps));
}

TEST(Worker, StartsWithPrimalSearchIfTheRootIsLarge) {
  for (const Technique without : {Technique::kPrimal, Technique::kBypass}) {
    Search s(Techniques::defaults().without(without), large_dense_instance());
    Worker worker = s.worker();
    EXPECT_EQ(Search::job_of(worker.choose()),
              without == Technique::kPrimal ? Job::kExpand : Job::kPrimal);
  }
  Search small(Techniques::defaults());
  EXPECT_EQ(Search::job_of(small.worker().choose()), Job::kExpand);
  Search fixed(Techniques::defaults(), large_dense_instance());
  fixed.options.policy = Policy::kFixed;
  EXPECT_EQ(Search::job_of(fixed.worker().choose()), Job::kExpand) << "plain CBS";
}

// Returns the plans that worker `number` finds in its first `items` primal work items.
std::vector<Plan> found_by(Search& s, int number, int items) {
  Worker worker = s.worker(number);
  for (int i = 0; i < items; ++i) {
    auto item = worker.choose();
    if (Search::job_of(item) != Job::kPrimal) break;
    worker.perform(*item, worker.expander());
    worker.commit(*item);
  }
  std::vector<Plan> plans;
  for (const auto& [plan, source] : s.bounds.posted) {
    EXPECT_NE(source, PlanSource::kTree);
    plans.push_back(plan);
  }
  return plans;
}

TEST(Worker, PrimalSearchOfEachWorkerHasItsOwnSeed) {
  const auto paths = [](int number) {
    Search s(Techniques::defaults(), large_dense_instance());
    s.nodes.frontier.take();  // so that no node can be expanded
    std::vector<Path> all;
    for (const Plan& plan : found_by(s, number, 40))
      for (const AgentPlan& agent : plan.agents) all.push_back(agent.path);
    return all;
  };
  EXPECT_FALSE(paths(0).empty());
  EXPECT_EQ(paths(0), paths(0));
  EXPECT_NE(paths(0), paths(1));
}

TEST(Worker, PrimalSearchFindsOnlyPlansBelowTheIncumbent) {
  Search s(Techniques::defaults(), large_dense_instance());
  s.nodes.frontier.take();
  const std::vector<Plan> plans = found_by(s, 0, 40);
  ASSERT_GT(plans.size(), 1u);
  Search with_incumbent(Techniques::defaults(), large_dense_instance());
  with_incumbent.nodes.frontier.take();
  with_incumbent.bounds.incumbent = plans.front();
  for (const Plan& plan : found_by(with_incumbent, 0, 40)) EXPECT_LT(plan.cost, plans.front().cost);
}

TEST(Worker, HelpsToBoundANodeOfAnotherWorker) {
  Search s({Technique::kWdg, Technique::kStrongBranching});
  Expansion unfinished;
  unfinished.unfinished = true;
  s.shared.finish(s.shared.take(), std::move(unfinished), 0);
  const NodePtr taken = s.shared.take();
  Worker worker = s.worker(1);
  int helps = 0;
  auto item = worker.choose();
  for (; Search::job_of(item) == Job::kHelp; item = worker.choose()) {
    ASSERT_LT(helps++, 100);
    EXPECT_EQ(item->node, taken);
    worker.perform(*item, worker.expander());
    Worker::publish(*item);
    worker.commit(*item);
  }
  EXPECT_GT(helps, 1) << "weights were computed first";
  EXPECT_FALSE(item) << "no other work is left";
  EXPECT_EQ(count(worker, "assists"), helps);
  EXPECT_GT(count(worker, "pair_expansions"), 0);
  EXPECT_EQ(s.observer.expansions, 0) << "the other worker expands the node";
  EXPECT_EQ(s.nodes.frontier.live(), 1u);
}

TEST(Worker, PreparesATreeOnlyWithoutOtherWork) {
  Search s({});
  s.source.may_prepare = true;
  Worker worker = s.worker();
  EXPECT_EQ(Search::job_of(worker.choose()), Job::kExpand);
  auto item = worker.choose();
  ASSERT_EQ(Search::job_of(item), Job::kPrepare);
  worker.perform(*item, worker.expander());
  EXPECT_EQ(s.source.prepared, 1);
  worker.commit(*item);
  EXPECT_EQ(s.observer.work_items, 1);
  EXPECT_FALSE(worker.turn());
}

TEST(Worker, OneWorkerSolvesAnInstance) {
  Search s({Technique::kStrongBranching});
  Worker worker = s.worker();
  while (s.bounds.posted.empty() || s.nodes.frontier.bound() < s.bounds.posted.back().first.cost)
    ASSERT_TRUE(worker.turn());
  EXPECT_EQ(s.bounds.posted.back().first.cost, 11);
}

}  // namespace worker_test
}  // namespace grove::detail
