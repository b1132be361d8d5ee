// SPDX-License-Identifier: MIT
// What one party of the protocol says when the others say just this: moments that schedules rarely
// meet.
#include <gtest/gtest.h>

#include <deque>
#include <utility>
#include <vector>

#include "grove/detail/engine/run_observer.h"
#include "grove/detail/search/single_tree.h"
#include "mpi/coordinator.h"
#include "mpi/rank.h"
#include "mpi/rank_nodes.h"
#include "tests/mpi/outbox.h"
#include "tests/primal/crowd.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace protocol_test {

using testing::Outbox;
using testing::random_crowd;

struct Setting {
  Limits limits;
  Instance instance =
      random_crowd({.size = 8, .obstacles = 10, .agents = 4, .tasks = 4, .no_destination = 0}, 1);
  Problem problem{instance, limits};
  AgentStopsStore stops{instance, problem.distances};
  NodePool pool;
  SolveOptions options;
  RunObserver observer;

  NodePtr new_root() {
    forests.emplace_back(problem, stops, pool, limits);
    return forests.back().next_root();
  }
  std::deque<SingleTree> forests;
};

// Rank 1 of three, which hears what the test says.
struct RankAlone : Setting {
  Outbox transport{1, 3};
  Rank rank{problem, options, limits, transport, stops};
  double now = 0;

  // What it has said last after this, if anything.
  message::Status status_after(int from, message::Message message) {
    rank.handle(from, std::move(message));
    rank.speak(now += 10);
    const auto said = transport.sent<message::Status>(0);
    return said.empty() ? message::Status() : said.back();
  }
};

using Taken = std::vector<std::pair<std::int32_t, std::int64_t>>;

TEST(RankAlone, SaysThatABatchWasTakenOverWhenItWas) {
  RankAlone r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  const auto status = r.status_after(2, message::Batch{0, {record_of(*root)}, {}});
  EXPECT_EQ(status.batches, Taken({{2, 1}}));
  EXPECT_EQ(status.bound, root->bound());
}

TEST(RankAlone, SaysNothingOfABatchWhoseTreeItHasNotHeardOf) {
  RankAlone r;
  const NodePtr root = r.new_root();
  const message::Batch batch{0, {record_of(*root)}, {}};
  EXPECT_TRUE(r.status_after(2, batch).batches.empty());
  EXPECT_EQ(r.status_after(2, message::Batch{}).batches, Taken()) << "those of a rank keep order";
  const auto status = r.status_after(0, message::NewTree{0, record_of(root->tree())});
  EXPECT_EQ(status.batches, Taken({{2, 2}}));
  EXPECT_EQ(status.bound, root->bound());
}

TEST(RankAlone, SaysNothingOfABatchOfALaterEra) {
  RankAlone r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  const auto early = r.status_after(2, message::Batch{1, {record_of(*root)}, {}});
  EXPECT_TRUE(early.batches.empty());
  const auto status = r.status_after(0, message::BeginAnew{0});
  EXPECT_EQ(status.batches, Taken({{2, 1}}));
  EXPECT_EQ(status.era, 1);
  EXPECT_EQ(status.bound, root->bound());
}

TEST(RankAlone, CoversWhatItGaveAwayUntilItIsReleased) {
  RankAlone r;
  const NodePtr root = r.new_root();
  r.rank.handle(0, message::NewTree{0, record_of(root->tree())});
  r.rank.handle(0, message::Entrust{{record_of(*root), record_of(*root)}, kInfiniteCost});
  const auto given = r.status_after(0, message::Order{2, 1});
  EXPECT_EQ(given.live, 2);
  EXPECT_EQ(given.open, 1);
  ASSERT_EQ(r.transport.sent<message::Batch>(2).size(), 1);
  const Frontier& frontier = r.rank.nodes().frontier;
  r.rank.handle(0, message::Release{2, 0});
  EXPECT_EQ(frontier.live(), 2);
  r.rank.handle(0, message::Release{2, 1});
  EXPECT_EQ(frontier.live(), 1);
}

TEST(RankNodes, CoverAllRootsOfANewBeginningUntilARankSaysThatItHasThem) {
  Setting s;
  Outbox transport(0, 2);
  RankNodes nodes(transport);
  const std::vector<NodePtr> roots{s.new_root(), s.new_root(), s.new_root()};
  nodes.restart(roots, 0);
  std::int64_t entrusted = 0;
  for (int rank = 0; rank < 2; ++rank) {
    EXPECT_EQ(transport.sent<message::BeginAnew>(rank).size(), 1);
    const auto told = transport.sent<message::Entrust>(rank);
    entrusted += std::ssize(told);
    for (std::int64_t obeyed = 0; obeyed < std::ssize(told); ++obeyed) {
      EXPECT_EQ(nodes.bound(), roots.front()->bound());
      EXPECT_TRUE(nodes.any());
      message::Status status;
      status.era = 1;
      status.entrusted = obeyed + 1;
      nodes.update(rank, status);
    }
  }
  EXPECT_EQ(entrusted, 3);
  EXPECT_EQ(nodes.bound(), kInfiniteCost);
  EXPECT_FALSE(nodes.any());
}

TEST(RankNodes, KnowNothingOfARankThatHasYetToHearOfANewBeginning) {
  Setting s;
  Outbox transport(0, 2);
  RankNodes nodes(transport);
  nodes.restart({}, 0);
  message::Status status;
  status.era = 1;
  nodes.update(0, status);
  EXPECT_TRUE(nodes.any());
  nodes.update(1, status);
  EXPECT_FALSE(nodes.any());
}

TEST(CoordinatorAlone, TellsAllAtOnceToLookForACheckpoint) {
  Setting s;
  const TemporaryDirectory folder;
  s.options.checkpoints.directory = folder.path();
  s.options.checkpoints.interval_s = 0;
  Outbox transport(0, 3);
  Coordinator coordinator(s.problem, s.options, s.limits, s.observer, transport);
  coordinator.begin();
  coordinator.step();
  for (int rank = 0; rank < 3; ++rank)
    EXPECT_EQ(transport.sent<message::Gather>(rank).size(), 1) << rank;
}

}  // namespace protocol_test
}  // namespace grove::detail
