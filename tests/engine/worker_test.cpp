// SPDX-License-Identifier: MIT
// What a worker finds to do, and what others see of it.
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

// A search whose workers the test leads.
struct Search : testing::SmallSearch {
  explicit Search(Techniques techniques, Instance the_instance = testing::two_in_a_bay())
      : SmallSearch(std::move(the_instance)) {
    options.omega = Omega();
    options.techniques = techniques;
    ledger.nodes = source.nodes = &nodes;
    nodes.push(root);
  }

  Worker worker(int number = 0) { return Worker(problem, options, limits, shared, stops, number); }
  static std::optional<Job> job_of(const std::optional<Worker::WorkItem>& turn) {
    return turn ? std::optional(turn->job) : std::nullopt;
  }

  SolveOptions options;
  testing::ToldLedger ledger;
  testing::CountingSource source;
  testing::CountingObserver observer;
  SharedSearch shared{options, limits, nodes, ledger, source, observer};
};

std::int64_t count(const Worker& worker, const std::string& name) {
  Stats stats;
  worker.add_counts(stats);
  return stats.counts.at(name);
}

Instance large_crowd() {
  return testing::random_crowd({.size = 12, .obstacles = 15, .agents = 16, .tasks = 16}, 1);
}

TEST(Worker, OthersSeeATurnWhenItIsCommitted) {
  Search s({});
  Worker worker = s.worker();
  auto turn = worker.choose();
  ASSERT_EQ(Search::job_of(turn), Job::kExpand);
  EXPECT_EQ(turn->node, s.root);
  worker.perform(*turn, worker.expander());
  Worker::publish(*turn);
  EXPECT_EQ(turn->expansion.children.size(), 2u);
  EXPECT_EQ(s.nodes.frontier.live(), 1u) << "the root, in hand";
  EXPECT_EQ(s.observer.expansions, 0);
  worker.commit(*turn);
  EXPECT_EQ(s.nodes.frontier.open(), 2u);
  EXPECT_EQ(s.observer.expansions, 1);
  EXPECT_EQ(s.observer.turns, 1);
}

// Labels, 16 for each call of the low level, and a quarter of the steps of the node's paths; and
// what else takes time.
TEST(Worker, CountsTheWorkOfATurn) {
  Search s({Technique::kStrongBranching, Technique::kWdg, Technique::kJointMdd});
  Worker worker = s.worker();
  for (int i = 0; i < 3; ++i) {
    auto turn = worker.choose();
    ASSERT_EQ(Search::job_of(turn), Job::kExpand);
    const ExpansionCounts before = worker.expander().counts();
    worker.perform(*turn, worker.expander());
    const ExpansionCounts after = worker.expander().counts();
    EXPECT_EQ(turn->work, after.low_level_expanded - before.low_level_expanded +
                              16 * (after.low_level_calls - before.low_level_calls) +
                              turn->node->cost() / 4 + 1);
    worker.commit(*turn);
  }
  const ExpansionCounts c = worker.expander().counts();
  EXPECT_GT(c.low_level_calls, 0);
  EXPECT_GT(c.joint_mdd_nodes, 0);
  EXPECT_EQ(count(worker, "low_level_calls"), c.low_level_calls);
  const std::int64_t work = c.low_level_expanded + 16 * c.low_level_calls;
  const auto times = [](double rate, std::int64_t of) { return rate * static_cast<double>(of); };
  EXPECT_DOUBLE_EQ(worker.expander().whole_work(),
                   times(1, work) + times(0.55, c.optimal_nodes) + times(0.85, c.joint_mdd_nodes) +
                       times(2, c.situations) + times(1.7, c.groups) + times(0.15, c.path_steps));
}

TEST(Worker, LooksForAPlanFirstWhereTheRootIsLarge) {
  for (const Technique without : {Technique::kPrimal, Technique::kBypass}) {
    Search s(Techniques::defaults().without(without), large_crowd());
    Worker worker = s.worker();
    EXPECT_EQ(Search::job_of(worker.choose()),
              without == Technique::kPrimal ? Job::kExpand : Job::kPrimal);
  }
  Search small(Techniques::defaults());
  EXPECT_EQ(Search::job_of(small.worker().choose()), Job::kExpand);
  Search fixed(Techniques::defaults(), large_crowd());
  fixed.options.policy = Policy::kFixed;
  EXPECT_EQ(Search::job_of(fixed.worker().choose()), Job::kExpand) << "plain CBS";
}

// The plans that a worker of this number finds beside the tree.
std::vector<Plan> found_by(Search& s, int number, int turns) {
  Worker worker = s.worker(number);
  for (int i = 0; i < turns; ++i) {
    auto turn = worker.choose();
    if (Search::job_of(turn) != Job::kPrimal) break;
    worker.perform(*turn, worker.expander());
    worker.commit(*turn);
  }
  std::vector<Plan> plans;
  for (const auto& [plan, source] : s.ledger.posted) {
    EXPECT_NE(source, PlanSource::kTree);
    plans.push_back(plan);
  }
  return plans;
}

TEST(Worker, EachNumberLooksForPlansFromAnotherSeed) {
  const auto paths = [](int number) {
    Search s(Techniques::defaults(), large_crowd());
    s.nodes.frontier.take();  // nothing to expand
    std::vector<Path> all;
    for (const Plan& plan : found_by(s, number, 40))
      for (const AgentPlan& agent : plan.agents) all.push_back(agent.path);
    return all;
  };
  EXPECT_FALSE(paths(0).empty());
  EXPECT_EQ(paths(0), paths(0));
  EXPECT_NE(paths(0), paths(1));
}

TEST(Worker, LooksForPlansCheaperThanTheIncumbent) {
  Search s(Techniques::defaults(), large_crowd());
  s.nodes.frontier.take();
  const std::vector<Plan> plans = found_by(s, 0, 40);
  ASSERT_GT(plans.size(), 1u);
  Search knowing(Techniques::defaults(), large_crowd());
  knowing.nodes.frontier.take();
  knowing.ledger.incumbent = plans.front();
  for (const Plan& plan : found_by(knowing, 0, 40)) EXPECT_LT(plan.cost, plans.front().cost);
}

TEST(Worker, HelpsWithANodeThatAnotherHasInHandUntilNothingIsLeft) {
  Search s({Technique::kWdg, Technique::kStrongBranching});
  Expansion unfinished;
  unfinished.unfinished = true;
  s.shared.finish(s.shared.take(), std::move(unfinished), 0);
  const NodePtr in_hand = s.shared.take();
  Worker worker = s.worker(1);
  int helps = 0;
  auto turn = worker.choose();
  for (; Search::job_of(turn) == Job::kHelp; turn = worker.choose()) {
    ASSERT_LT(helps++, 100);
    EXPECT_EQ(turn->node, in_hand);
    worker.perform(*turn, worker.expander());
    Worker::publish(*turn);
    worker.commit(*turn);
  }
  EXPECT_GT(helps, 1) << "something was found out first";
  EXPECT_FALSE(turn) << "nothing else is to be done";
  EXPECT_EQ(count(worker, "assists"), helps);
  EXPECT_GT(count(worker, "pair_expansions"), 0);
  EXPECT_EQ(s.observer.expansions, 0) << "the node is the other's";
  EXPECT_EQ(s.nodes.frontier.live(), 1u);
}

TEST(Worker, PreparesATreeOnlyWhenThereIsNothingElse) {
  Search s({});
  s.source.may_prepare = true;
  Worker worker = s.worker();
  EXPECT_EQ(Search::job_of(worker.choose()), Job::kExpand);
  auto turn = worker.choose();
  ASSERT_EQ(Search::job_of(turn), Job::kPrepare);
  worker.perform(*turn, worker.expander());
  EXPECT_EQ(s.source.prepared, 1);
  worker.commit(*turn);
  EXPECT_EQ(s.observer.turns, 1);
  EXPECT_FALSE(worker.turn());
}

TEST(Worker, SolvesAlone) {
  Search s({Technique::kStrongBranching});
  Worker worker = s.worker();
  while (s.ledger.posted.empty() || s.nodes.frontier.bound() < s.ledger.posted.back().first.cost)
    ASSERT_TRUE(worker.turn());
  EXPECT_EQ(s.ledger.posted.back().first.cost, 11);
}

}  // namespace worker_test
}  // namespace grove::detail
