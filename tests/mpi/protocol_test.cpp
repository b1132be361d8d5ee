// SPDX-License-Identifier: MIT
// Tests the replies of one party of the protocol to given messages from the others, in cases that
// random schedules rarely reach.
#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "engine/run_observer.h"
#include "mpi/coordinator.h"
#include "mpi/rank.h"
#include "mpi/rank_nodes.h"
#include "mpi/sub_coordinator.h"
#include "search/single_tree.h"
#include "tests/mpi/outbox.h"
#include "tests/primal/crowd.h"
#include "tests/support/clocks.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace protocol_test {

using std::chrono::milliseconds;
using testing::ManualClock;
using testing::Outbox;
using testing::random_crowd;

struct Setting {
  Limits limits;
  Instance instance =
      random_crowd({.size = 8, .obstacles = 10, .agents = 4, .tasks = 4, .no_destination = 0}, 1);
  Problem problem{instance, limits};
  AgentStopsCache stops{instance, problem.distances};
  NodePool pool;
  SolveOptions options;
  RunObserver observer;

  NodePtr new_root() {
    forests.emplace_back(problem, stops, pool, limits);
    return forests.back().next_root();
  }
  std::deque<SingleTree> forests;
};

// Rank 1 of three ranks. It receives only the messages that the test passes to it.
struct IsolatedRank : Setting {
  Outbox transport{1, 3};
  Rank rank{problem, options, limits, transport, stops};
  double now = 0;

  // Passes the message to the rank. Returns the last status that the rank has sent to rank 0, or a
  // default status if it has sent none.
  message::Status status_after(int from, message::Message message) {
    rank.handle(from, std::move(message));
    rank.send_updates(now += 10);
    const auto sent = transport.sent<message::Status>(0);
    return sent.empty() ? message::Status() : sent.back();
  }
};

using BatchReceived = std::vector<message::BatchReceived>;

TEST(IsolatedRank, ReportsAReceivedBatch) {
  IsolatedRank r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  const auto status = r.status_after(2, message::NodeBatch{0, {record_of(*root)}, {}});
  EXPECT_EQ(status.taken, BatchReceived({{1, 2, 1}}));
  EXPECT_EQ(status.bound, root->bound());
}

TEST(IsolatedRank, DefersABatchOfAnUnknownTree) {
  IsolatedRank r;
  const NodePtr root = r.new_root();
  const message::NodeBatch batch{0, {record_of(*root)}, {}};
  EXPECT_TRUE(r.status_after(2, batch).taken.empty());
  EXPECT_EQ(r.status_after(2, message::NodeBatch{}).taken, BatchReceived())
      << "batches of one rank keep their order";
  const auto status = r.status_after(0, message::NewTree{0, record_of(root->tree())});
  EXPECT_EQ(status.taken, BatchReceived({{1, 2, 2}}));
  EXPECT_EQ(status.bound, root->bound());
}

TEST(IsolatedRank, DefersABatchOfALaterEpoch) {
  IsolatedRank r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  const auto early = r.status_after(2, message::NodeBatch{1, {record_of(*root)}, {}});
  EXPECT_TRUE(early.taken.empty());
  const auto status = r.status_after(0, message::Restart{0});
  EXPECT_EQ(status.taken, BatchReceived({{1, 2, 1}}));
  EXPECT_EQ(status.epoch, 1);
  EXPECT_EQ(status.bound, root->bound());
}

TEST(IsolatedRank, CoversSentNodesUntilTheyAreReleased) {
  IsolatedRank r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  r.rank.handle(0, message::AssignNodes{{record_of(*root), record_of(*root)}, kInfiniteCost});
  const auto given = r.status_after(0, message::SendNodes{2, 1});
  EXPECT_EQ(r.rank.nodes().frontier.live(), 2);
  EXPECT_EQ(given.open, 1);
  ASSERT_EQ(r.transport.sent<message::NodeBatch>(2).size(), 1);
  const Frontier& frontier = r.rank.nodes().frontier;
  r.rank.handle(0, message::ReleaseCustody{1, 2, 0});
  EXPECT_EQ(frontier.live(), 2);
  r.rank.handle(0, message::ReleaseCustody{1, 2, 1});
  EXPECT_EQ(frontier.live(), 1);
}

TEST(IsolatedRank, SendsItsNextNodeOnlyToAnIdleRank) {
  IsolatedRank r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  r.rank.handle(0, message::AssignNodes{{record_of(*root), record_of(*root)}, kInfiniteCost});
  const NodePtr taken = r.rank.components().tree().take();
  ASSERT_TRUE(taken);
  const auto kept = r.status_after(0, message::SendNodes{2, 1, false});
  EXPECT_EQ(kept.open, 1);
  EXPECT_EQ(kept.surplus, std::vector<message::Surplus>({{root->bound(), 0, 1}}));
  const auto given = r.status_after(0, message::SendNodes{2, 1, true});
  EXPECT_EQ(given.open, 0);
  EXPECT_TRUE(given.surplus.empty());
}

TEST(IsolatedRank, MayEndWithAnUnfinishedNode) {
  IsolatedRank r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  r.rank.handle(0, message::AssignNodes{{record_of(*root)}, kInfiniteCost});
  Expansion expansion;
  expansion.unfinished = true;
  r.rank.components().tree().finish(r.rank.components().tree().take(), std::move(expansion), 0);
  Plan plan;
  plan.cost = root->bound();
  r.rank.handle(0, message::Incumbent{plan});
  EXPECT_EQ(r.rank.nodes().frontier.live(), 0);
  EXPECT_TRUE(r.rank.components().tree().unfinished()) << "no other rank holds it";
}

TEST(IsolatedRank, ReportIntervalGrowsWithTheRun) {
  IsolatedRank r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  r.rank.handle(0, message::AssignNodes{std::vector(300, record_of(*root)), kInfiniteCost});
  const auto statuses_from = [&](double begin) {
    r.rank.send_updates(begin);
    r.transport.take();
    for (int ms = 1; ms <= 100; ++ms) {
      r.rank.components().tree().finish(r.rank.components().tree().take(), {}, 0);
      r.rank.send_updates(begin + 1e-3 * ms);
    }
    return r.transport.sent<message::Status>(0).size();
  };
  const auto soon = statuses_from(0);
  const auto late = statuses_from(100);
  EXPECT_GE(soon, 20u);
  EXPECT_GE(late, 2u);
  EXPECT_LE(late, 10u);
}

TEST(IsolatedRank, ReducesBoundingEffortWhileOthersWaitForNodes) {
  IsolatedRank r;
  TreeSearch& search = r.rank.components().tree();
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  const auto give = [&](std::size_t nodes) {
    r.rank.handle(0, message::AssignNodes{std::vector(nodes, record_of(*root)), kInfiniteCost});
  };
  const auto expand = [&] {
    search.finish(search.take(), {}, 0);
    r.rank.send_updates(r.now += 10);
  };
  give(20);
  EXPECT_EQ(search.bounding_effort(), BoundingEffort::kCachedOnly) << "at the beginning of the run";
  for (int i = 0; i < 5; ++i) expand();
  EXPECT_EQ(search.bounding_effort(), BoundingEffort::kFull);
  r.rank.handle(0, message::SendNodes{2, 1, false});
  EXPECT_EQ(search.bounding_effort(), BoundingEffort::kFull);
  r.rank.handle(0, message::SendNodes{2, 1, true});
  EXPECT_EQ(search.bounding_effort(), BoundingEffort::kCachedOnly);
  expand();
  EXPECT_EQ(search.bounding_effort(), BoundingEffort::kCachedOnly);
  for (int i = 0; i < 5; ++i) expand();
  EXPECT_EQ(search.bounding_effort(), BoundingEffort::kFull);
}

TEST(RankNodes, CoverAllRootsOfARestartUntilRanksReportThem) {
  Setting s;
  Outbox transport(0, 2);
  ChildLinks children(transport, Hierarchy(2, 64), 1);
  RankNodes nodes(children);
  const std::vector<NodePtr> roots{s.new_root(), s.new_root(), s.new_root()};
  nodes.restart(roots, 0);
  std::int64_t total = 0;
  for (int rank = 0; rank < 2; ++rank) {
    EXPECT_EQ(transport.sent<message::Restart>(rank).size(), 1);
    const auto assigned = transport.sent<message::AssignNodes>(rank);
    total += std::ssize(assigned);
    for (std::int64_t pushed = 0; pushed < std::ssize(assigned); ++pushed) {
      EXPECT_EQ(nodes.bound(), roots.front()->bound());
      EXPECT_TRUE(nodes.any());
      message::Status status;
      status.epoch = 1;
      status.assigned = pushed + 1;
      nodes.update(rank, status);
    }
  }
  EXPECT_EQ(total, 3);
  EXPECT_EQ(nodes.bound(), kInfiniteCost);
  EXPECT_FALSE(nodes.any());
}

TEST(RankNodes, AreNotEmptyBeforeAllRanksHaveRestarted) {
  Setting s;
  Outbox transport(0, 2);
  ChildLinks children(transport, Hierarchy(2, 64), 1);
  RankNodes nodes(children);
  nodes.restart({}, 0);
  message::Status status;
  status.epoch = 1;
  nodes.update(0, status);
  EXPECT_TRUE(nodes.any());
  nodes.update(1, status);
  EXPECT_FALSE(nodes.any());
}

TEST(IsolatedCoordinator, RequestsSnapshotsFromAllRanksAtOnce) {
  Setting s;
  const TemporaryDirectory folder;
  s.options.checkpoints.directory = folder.path();
  s.options.checkpoints.interval_s = 0;
  Outbox transport(0, 3);
  Coordinator coordinator(s.problem, s.options, s.limits, s.observer, transport);
  coordinator.begin();
  coordinator.step();
  for (int rank = 0; rank < 3; ++rank)
    EXPECT_EQ(transport.sent<message::SnapshotRequest>(rank).size(), 1) << rank;
}

TEST(IsolatedCoordinator, EndsWithoutUnresponsiveRanksAfterALimit) {
  Setting s;
  ManualClock clock(s.limits);
  const TemporaryDirectory folder;
  s.options.checkpoints.directory = folder.path();
  s.options.checkpoints.interval_s = 0;
  Outbox transport(0, 3);
  Coordinator coordinator(s.problem, s.options, s.limits, s.observer, transport);
  coordinator.begin();
  coordinator.step();
  const auto wait = [&] { clock.advance(milliseconds(701)); };
  wait();
  EXPECT_EQ(coordinator.check_unresponsive_ranks(), 0);
  coordinator.handle(1, message::SnapshotTaken{});  // rank 1 takes part: no limit yet
  s.limits.stop(StopReason::kTime);
  EXPECT_EQ(coordinator.check_unresponsive_ranks(), 0) << "a message of rank 1 has just arrived";
  clock.advance(milliseconds(699));
  EXPECT_EQ(coordinator.check_unresponsive_ranks(), 0) << "the timeout is not over";
  coordinator.step();
  EXPECT_TRUE(transport.sent<message::Terminate>(1).empty());
  clock.advance(milliseconds(1));
  EXPECT_EQ(coordinator.check_unresponsive_ranks(), 0) << "the checkpoint comes first";
  coordinator.handle(2, message::SnapshotTaken{});  // after the timeout
  coordinator.step();
  EXPECT_EQ(transport.sent<message::Terminate>(1).size(), 1);
  message::RankFinished finished;
  finished.statistics.ranks[1] = {};
  coordinator.handle(1, std::move(finished));
  EXPECT_EQ(coordinator.check_unresponsive_ranks(), 0);
  wait();
  EXPECT_EQ(coordinator.check_unresponsive_ranks(), 1) << "rank 2; rank 0 is responsive";
  EXPECT_GT(coordinator.conclude().lower_bound, 0);
}

TEST(IsolatedCoordinator, MeasuresUnresponsivenessFromTheLimit) {
  for (const int ranks : {1, 3}) {
    Setting s;
    ManualClock clock(s.limits);
    Outbox transport(0, ranks);
    Coordinator coordinator(s.problem, s.options, s.limits, s.observer, transport);
    coordinator.begin();
    clock.advance(milliseconds(5000));
    s.limits.stop(StopReason::kTime);
    coordinator.step();
    EXPECT_EQ(transport.sent<message::Terminate>(0).size(), 1);
    EXPECT_EQ(coordinator.check_unresponsive_ranks(), 0);
    clock.advance(milliseconds(1399));
    EXPECT_EQ(coordinator.check_unresponsive_ranks(), 0)
        << "ranks may be in the middle of a work item";
    clock.advance(milliseconds(1));
    EXPECT_EQ(coordinator.check_unresponsive_ranks(), ranks - 1);
  }
}

// The sub-coordinator for ranks 3, 4 and 5, which runs on rank 3 of nine ranks in groups of three.
// It receives only the messages that the test passes to it.
struct SubCoordinatorOfThree {
  Outbox transport{3, 9};
  SubCoordinator sub{transport, Hierarchy(9, 3), 1, Tuning()};
  double now = 0;

  // Passes the message to the sub-coordinator. Returns the last status that it has sent to its
  // parent, or a default status if it has sent none.
  message::Status status_after(int from, message::Message message) {
    sub.handle(from, std::move(message));
    sub.send_updates(now += 10);
    const auto sent = transport.sent<message::Status>(0);
    return sent.empty() ? message::Status() : sent.back();
  }
  static message::Status with(Cost bound, std::int64_t nodes) {
    message::Status status;
    status.live = true;
    status.bound = bound;
    status.open = 2 * nodes;
    if (nodes > 0) status.surplus = {{bound, nodes}};
    return status;
  }
};

TEST(IsolatedSubCoordinator, ReportsTheLeastBoundOfItsRanks) {
  SubCoordinatorOfThree s;
  EXPECT_EQ(s.status_after(4, SubCoordinatorOfThree::with(20, 0)).bound, 20);
  EXPECT_EQ(s.status_after(5, SubCoordinatorOfThree::with(18, 0)).bound, 18);
  EXPECT_EQ(s.status_after(5, SubCoordinatorOfThree::with(25, 0)).bound, 20);
  message::Status evicted;
  evicted.bound = evicted.evicted_bound = 19;
  const auto all = s.status_after(4, evicted);
  EXPECT_EQ(all.bound, 19);
  EXPECT_EQ(all.evicted_bound, 19);
  EXPECT_TRUE(all.live);
}

TEST(IsolatedSubCoordinator, CoversAssignedNodesUntilReported) {
  Setting setting;
  SubCoordinatorOfThree s;
  const NodePtr root = setting.new_root();
  const message::AssignNodes nodes{{record_of(*root)}, kInfiniteCost};
  auto status = s.status_after(0, nodes);
  EXPECT_EQ(status.assigned, 1);
  EXPECT_EQ(status.bound, root->bound());
  EXPECT_TRUE(status.live);
  ASSERT_EQ(s.transport.sent<message::AssignNodes>(3).size(), 1);
  message::Status has_it = SubCoordinatorOfThree::with(root->bound() + 1, 0);
  has_it.assigned = 1;
  status = s.status_after(3, has_it);
  EXPECT_EQ(status.bound, root->bound() + 1);
}

TEST(IsolatedSubCoordinator, ReleasesOnlyBatchesBetweenItsRanks) {
  SubCoordinatorOfThree s;
  message::Status took = SubCoordinatorOfThree::with(20, 0);
  took.taken = {{4, 5, 3}, {4, 8, 1}};
  const auto status = s.status_after(4, took);
  EXPECT_EQ(status.taken, BatchReceived({{4, 8, 1}}));
  EXPECT_EQ(status.bound, 20) << "the same status covers them";
  const auto released = s.transport.sent<message::ReleaseCustody>(5);
  ASSERT_EQ(released.size(), 1);
  EXPECT_EQ(released[0].to, 4);
  EXPECT_EQ(released[0].batches, 3);
  EXPECT_TRUE(s.status_after(5, SubCoordinatorOfThree::with(30, 0)).taken.empty()) << "once";
}

TEST(IsolatedSubCoordinator, KeepsItsEpochUntilAllRanksRestarted) {
  SubCoordinatorOfThree s;
  EXPECT_EQ(s.status_after(0, message::Restart{7}).epoch, 0);
  message::Status restarted;
  restarted.epoch = 1;
  for (const int rank : {3, 4}) EXPECT_EQ(s.status_after(rank, restarted).epoch, 0);
  EXPECT_EQ(s.status_after(5, restarted).epoch, 1);
  for (const int rank : {3, 4, 5}) EXPECT_EQ(s.transport.sent<message::Restart>(rank).size(), 1);
}

TEST(IsolatedSubCoordinator, BalancesItsRanksAndOffersTheRest) {
  SubCoordinatorOfThree s;
  const auto status = s.status_after(4, SubCoordinatorOfThree::with(20, 200));
  const auto orders = s.transport.sent<message::SendNodes>(4);
  ASSERT_EQ(orders.size(), 2);
  EXPECT_EQ(orders[0].to, 3);
  EXPECT_EQ(orders[1].to, 5);
  ASSERT_EQ(status.surplus.size(), 1);
  EXPECT_EQ(status.surplus[0].nodes, 200 - orders[0].count - orders[1].count);
  EXPECT_TRUE(status.work_requests.empty()) << "ranks that wait for a transfer request no work";
  s.sub.handle(0, message::SendNodes{7, 10});
  ASSERT_EQ(s.transport.sent<message::SendNodes>(4).size(), 3);
  EXPECT_EQ(s.transport.sent<message::SendNodes>(4).back().to, 7);
}

TEST(IsolatedSubCoordinator, ForwardsSendNodesEvenIfNoRankHasNodes) {
  SubCoordinatorOfThree s;
  s.sub.handle(0, message::SendNodes{7, 10});
  EXPECT_EQ(s.transport.sent<message::SendNodes>(3).size(), 1) << "the receiver waits for a batch";
}

TEST(IsolatedSubCoordinator, ForwardsOnlyImprovingPlans) {
  SubCoordinatorOfThree s;
  Plan plan;
  plan.cost = 50;
  s.sub.handle(0, message::Incumbent{plan});
  s.sub.handle(4, message::NewPlan{plan, PlanSource{}});
  EXPECT_TRUE(s.transport.sent<message::NewPlan>(0).empty());
  plan.cost = 49;
  s.sub.handle(4, message::NewPlan{plan, PlanSource{}});
  s.sub.handle(5, message::NewPlan{plan, PlanSource{}});
  EXPECT_EQ(s.transport.sent<message::NewPlan>(0).size(), 2) << "the first is not yet checked";
}

TEST(IsolatedSubCoordinator, SendsOneRankFinishedForAllItsRanks) {
  SubCoordinatorOfThree s;
  s.sub.handle(0, message::Terminate{});
  s.status_after(4, SubCoordinatorOfThree::with(20, 8));
  for (const int rank : {3, 4, 5}) {
    EXPECT_TRUE(s.transport.sent<message::RankFinished>(0).empty());
    message::RankFinished finished;
    finished.statistics.whole.counts["nodes_expanded"] = rank;
    finished.statistics.ranks[rank].expanded = rank;
    finished.messages = {{8, 1}, {rank, 2}};
    s.sub.handle(rank, std::move(finished));
  }
  s.sub.send_updates(s.now += 10);
  EXPECT_TRUE(s.transport.sent<message::Status>(0).empty());
  EXPECT_TRUE(s.transport.sent<message::SendNodes>(4).empty());
  const auto sent = s.transport.sent<message::RankFinished>(0);
  ASSERT_EQ(sent.size(), 1);
  EXPECT_EQ(sent[0].statistics.whole.counts.at("nodes_expanded"), 12);
  EXPECT_EQ(sent[0].statistics.ranks.size(), 3);
  EXPECT_EQ(sent[0].messages,
            (std::map<std::int32_t, std::int64_t>{{3, 2}, {4, 2}, {5, 2}, {8, 3}}));
  s.sub.handle(0, message::MessageCounts{{{3, 7}, {5, 9}}});
  EXPECT_EQ(s.transport.sent<message::MessageCounts>(5).at(0).messages.at(5), 9);
  EXPECT_TRUE(s.transport.sent<message::MessageCounts>(4).at(0).messages.empty());
}

}  // namespace protocol_test
}  // namespace grove::detail
