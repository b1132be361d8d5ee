// SPDX-License-Identifier: MIT
// Tests simulated runs. With one rank a simulated run expands the same nodes as a real run, the
// answer does not depend on the number of ranks or the machine, and the statistics are consistent.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "model/check.h"
#include "mpi/simulator/busy_profile.h"
#include "mpi/simulator/scaling_table.h"
#include "mpi/simulator/simulated_worker.h"
#include "mpi/simulator/simulation.h"
#include "mpi/simulator/timed_transport.h"
#include "tests/primal/crowd.h"
#include "tests/search/root_fixture.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace simulator_test {

using testing::random_crowd;

// An instance for which plain CBS needs many nodes, with its optimal solution.
struct Case {
  Instance instance;
  Solution truth;
};

SolveOptions plain() {
  SolveOptions options;
  options.omega = Omega();
  options.techniques = {Technique::kStrongBranching};
  return options;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> found;
    for (std::uint64_t seed = 0; found.size() < 2; ++seed) {
      Instance instance = random_crowd({.size = 8, .obstacles = 20, .agents = 6, .tasks = 8}, seed);
      const testing::ClockReadingLimit limits(200'000);
      SolveOptions options;
      options.omega = Omega();
      Solution truth = solve(instance, options, limits);
      if (truth.status != Status::kOptimal) continue;
      options = plain();
      options.start = truth.plan;
      const Solution plain_run = solve(instance, options, limits);
      if (plain_run.status != Status::kOptimal) continue;
      if (plain_run.stats.counts.at("nodes_expanded") < 300) continue;
      found.push_back({std::move(instance), plain_run});
    }
    return found;
  }();
  return all;
}

constexpr Machine kMachine{.seconds_per_work = 1e-6};

SimulatedRun run_of(const Case& c, const SolveOptions& options, int ranks,
                    const Machine& machine = kMachine) {
  const Limits limits;
  const Problem problem(c.instance, limits);
  return simulate(problem, options, limits, ranks, machine);
}

SolveOptions with_start(const Case& c) {
  SolveOptions options = plain();
  options.start = c.truth.plan;
  return options;
}

TEST(Simulator, OneRankExpandsTheNodesOfASequentialRun) {
  for (const Case& c : cases()) {
    const SimulatedRun run = run_of(c, with_start(c), 1);
    ASSERT_TRUE(run.ended);
    EXPECT_EQ(run.solution.stats.counts.at("nodes_expanded"),
              c.truth.stats.counts.at("nodes_expanded"));
    EXPECT_EQ(run.solution.stats.counts.at("nodes_generated"),
              c.truth.stats.counts.at("nodes_generated"));
  }
}

TEST(Simulator, AnyNumberOfRanksFindsTheOptimum) {
  std::int64_t sent = 0;
  for (const Case& c : cases())
    for (const int ranks : {1, 3, 16, 64})
      for (const SolveOptions& options : {plain(), with_start(c)}) {
        const SimulatedRun run = run_of(c, options, ranks);
        ASSERT_TRUE(run.ended);
        EXPECT_EQ(run.solution.status, Status::kOptimal);
        EXPECT_EQ(run.solution.lower_bound, c.truth.lower_bound) << ranks << " ranks";
        EXPECT_TRUE(check(c.instance, run.solution).empty());
        sent += run.solution.stats.counts.at("nodes_sent");
      }
  EXPECT_GT(sent, 500) << "too few nodes were sent to test anything";
}

TEST(Simulator, AnswerDoesNotDependOnTheMachine) {
  const std::vector<Machine> machines = {
      {.latency = 0, .message_cost = 0, .poll = 0, .seconds_per_work = 1e-6},
      {.latency = 1e-2, .seconds_per_work = 1e-6},
      {.latency = 10, .seconds_per_work = 1e-6},
      {.bandwidth = 1e3, .seconds_per_work = 1e-6},
      {.message_cost = 1e-2, .seconds_per_work = 1e-6},
      {.poll = 0.1, .seconds_per_work = 1e-8},
      {.seconds_per_work = 1}};
  for (const Case& c : cases())
    for (const Machine& machine : machines) {
      const SimulatedRun run = run_of(c, with_start(c), 7, machine);
      ASSERT_TRUE(run.ended);
      EXPECT_EQ(run.solution.status, Status::kOptimal);
      EXPECT_EQ(run.solution.lower_bound, c.truth.lower_bound);
    }
}

TEST(Simulator, RanksPriceSubproblemsForRankZero) {
  const Machine quick{
      .latency = 0, .bandwidth = 1e15, .message_cost = 0, .poll = 0, .seconds_per_work = 1e-6};
  std::int64_t prices = 0;
  for (const Case& c : cases())
    for (const int ranks : {1, 3, 16}) {
      SolveOptions options = with_start(c);
      options.techniques = options.techniques.with(Technique::kLagrangian);
      options.tuning.lagrangian_min_agents = 1;
      options.tuning.lagrangian_start_work = 0;
      options.tuning.lagrangian_min_remote_work = options.tuning.lagrangian_step_work = 1;
      const SimulatedRun run = run_of(c, options, ranks, quick);
      ASSERT_TRUE(run.ended);
      EXPECT_EQ(run.solution.status, Status::kOptimal);
      EXPECT_EQ(run.solution.lower_bound, c.truth.lower_bound);
      const auto& counts = run.solution.stats.counts;
      EXPECT_GT(counts.at("lagrangian_rounds"), 0);
      EXPECT_TRUE(ranks > 1 || !counts.contains("remote_pricings"));
      if (ranks > 1) prices += counts.at("remote_pricings");
    }
  EXPECT_GT(prices, 10);
}

TEST(Simulator, RunIsRepeatable) {
  const Case& c = cases().front();
  const auto table = [&] {
    std::vector<std::string> lines;
    const SimulatedRun alone = run_of(c, with_start(c), 1);
    for (const int ranks : {1, 2, 16, 64}) {
      const SimulatedRun run = run_of(c, with_start(c), ranks);
      lines.push_back(csv_line(scaling_row(run, alone)));
      EXPECT_EQ(std::ranges::count(lines.back(), ','), std::ranges::count(scaling_header(), ','));
    }
    return lines;
  };
  EXPECT_EQ(table(), table());
}

TEST(Simulator, StatisticsAreConsistent) {
  for (const Case& c : cases()) {
    const SimulatedRun alone = run_of(c, with_start(c), 1);
    for (const int ranks : {1, 5, 32}) {
      const SimulatedRun run = run_of(c, with_start(c), ranks);
      double busy = 0;
      double most = 0;
      double work = 0;
      for (const SimulatedRun::Rank& rank : run.ranks) {
        busy += rank.worker.busy_s;
        most = std::max(most, rank.worker.busy_s);
        work += rank.worker.work;
        EXPECT_LE(rank.communication_s, run.wall_s * 1.000001);
      }
      EXPECT_LE(most, run.wall_s);
      const double profiled = std::accumulate(run.busy.begin(), run.busy.end(), 0.0) * run.wall_s /
                              SimulatedRun::kParts;
      EXPECT_NEAR(profiled, busy, 1e-6 * busy + 1e-9);
      EXPECT_LE(busy, work * kMachine.seconds_per_work *
                          1.000001);  // less, because some work items are abandoned
      const ScalingRow row = scaling_row(run, alone);
      EXPECT_NEAR(row.expanding_s, row.wall_s * ranks * (1 - row.idle_share), 1e-6 * busy);
      EXPECT_GE(row.max_over_mean, 0.999999);
      EXPECT_NEAR(row.efficiency * ranks, row.speed_up, 1e-9);
    }
  }
}

TEST(Simulator, ExpensiveMessagesSlowTheCoordinatorAndTheRun) {
  const Case& c = cases().front();
  const SimulatedRun alone = run_of(c, with_start(c), 1);
  const ScalingRow cheap = scaling_row(run_of(c, with_start(c), 32), alone);
  const ScalingRow expensive = scaling_row(
      run_of(c, with_start(c), 32, {.message_cost = 1e-3, .seconds_per_work = 1e-6}), alone);
  EXPECT_GT(expensive.coordinator_wait_s, 5 * cheap.coordinator_wait_s);
  EXPECT_GT(expensive.coordinator_communication_share, cheap.coordinator_communication_share);
  EXPECT_LT(expensive.speed_up, cheap.speed_up);
}

TEST(Simulator, StopsAtItsLimits) {
  const Case& c = cases().front();
  Limits limits;
  const Problem problem(c.instance, limits);
  limits.set_deadline(testing::kPast);
  const SimulatedRun run = simulate(problem, with_start(c), limits, 16, kMachine);
  EXPECT_FALSE(run.ended);
  EXPECT_LE(run.solution.lower_bound, c.truth.lower_bound);
  EXPECT_EQ(scaling_row(run, run).status, "unfinished");
}

TEST(BusyProfile, KeepsSumsOfLongRuns) {
  BusyProfile profile;
  profile.add(0, 1e-6);
  profile.add(0.25, 1);
  profile.add(0.5, 1);
  const auto soon = profile.means(1, 4);
  EXPECT_NEAR(soon[0], 4e-6, 1e-9);
  EXPECT_NEAR(soon[1], 1, 1e-3);
  EXPECT_NEAR(soon[2], 2, 1e-3);
  EXPECT_NEAR(soon[3], 2, 1e-3);
  profile.add(900, 1000);
  const auto late = profile.means(1000, 10);
  EXPECT_NEAR(late[0], 1.25e-2, 1e-4);
  EXPECT_NEAR(late[5], 0, 1e-9);
  EXPECT_NEAR(late[9], 1, 1e-3);
}

TEST(MddInterner, HoldsEachMddOnceWhileInUse) {
  const Instance instance = random_crowd({.size = 8, .obstacles = 20, .agents = 2, .tasks = 0}, 1);
  testing::RootFixture s(instance);
  const auto made = [&](AgentIndex agent, Time later) {
    return MddCache::make(s.planner, agent, s.view.order(agent), {}, s.view.cost_of(agent) + later,
                          1000, s.limits);
  };
  MddInterner interner;
  const MddCache::Set first = interner.one_of(made(0, 0));
  MddCache::Set longer = interner.one_of(made(0, 1));
  EXPECT_EQ(interner.one_of(made(0, 0)), first);
  EXPECT_EQ(interner.one_of(made(0, 1)), longer);
  EXPECT_NE(*first, *longer);
  EXPECT_EQ(interner.size(), 2u);
  const std::weak_ptr<const Mdd> watched = longer;
  longer.reset();
  EXPECT_TRUE(watched.expired());
  for (Time later = 2; later < 3000; ++later) interner.one_of(made(1, later % 20));
  EXPECT_LE(interner.size(), 1001u);
  EXPECT_EQ(interner.one_of(made(0, 0)), first);
}

TEST(TimedTransport, SendsMessagesOneAfterTheOther) {
  const Machine machine{.latency = 1, .bandwidth = 10, .message_cost = 0.5};
  Communication communication;
  SimulatedNetwork network(
      3, [&](int, int, std::size_t) { return communication.takes_s + machine.latency; });
  TimedTransport from(network, 0, machine, communication);
  TimedTransport to(network, 2, machine, communication);
  from.send(1, "12345");
  from.send(2, "");
  from.send(2, "x");
  EXPECT_NEAR(communication.takes_s, 3 * 0.5 + 0.6, 1e-9);
  EXPECT_EQ(communication.receivers, (std::vector<int>{1, 2, 2}));
  EXPECT_NEAR(network.next_arrival(1), 2, 1e-9);
  EXPECT_NEAR(network.next_arrival(2), 2.5, 1e-9);
  network.advance_to(4);
  communication = {};
  EXPECT_TRUE(to.receive());
  EXPECT_TRUE(to.receive());
  EXPECT_FALSE(to.receive());
  EXPECT_EQ(to.received(), 2);
  EXPECT_NEAR(communication.takes_s, 1.1, 1e-9);
  EXPECT_NEAR(to.waited_s(), (4 - 2.5) + (4 + 0.5 - 3.1), 1e-9);
}

}  // namespace simulator_test
}  // namespace grove::detail
