// SPDX-License-Identifier: MIT
// Tests when and how a rank reports its nodes.
#include "mpi/rank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/run_observer.h"
#include "engine/solve.h"
#include "mpi/coordinator.h"
#include "search/expander.h"
#include "tests/mpi/outbox.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace rank_test {

// A rank that has received the root of a tree and, if excess >= 0, an incumbent whose cost exceeds
// the root's bound by `excess`.
class RankWithRoot {
 public:
  RankWithRoot(Omega omega, Cost excess)
      : instance_(testing::random_crowd({.size = 8, .obstacles = 20, .agents = 6, .tasks = 8}, 0)),
        options_(with(omega)),
        problem_(instance_, limits_),
        stops_(instance_, problem_.distances),
        rank_(problem_, options_, limits_, network_, stops_),
        expander_(problem_, stops_, search_options_of(options_)) {
    Coordinator(problem_, options_, limits_, observer_, network_).begin();
    for (message::Message& message : network_.take()) rank_.handle(0, std::move(message));
    bound_ = rank_.nodes().bound();
    if (excess < 0) return;
    Plan plan;
    plan.cost = bound_ + excess;
    rank_.handle(0, message::Incumbent{plan});
  }

  // Returns the status that the rank sends at time `now`, or nullopt if it sends none.
  std::optional<message::Status> send_updates(double now) {
    rank_.send_updates(now);
    std::optional<message::Status> reported;
    for (const message::Message& message : network_.take())
      if (const auto* status = std::get_if<message::Status>(&message)) reported = *status;
    return reported;
  }
  // Expands one node. Returns false if there is no node left.
  bool expand() {
    TreeSearch& search = rank_.components().tree();
    const NodePtr node = search.take();
    if (!node) return false;
    expander_.use_shared_cache(rank_.components().memory().cache());
    search.finish(node,
                  expander_.expand(node, rank_.components().context().bounds.cutoff(), limits_), 0);
    return true;
  }
  Cost bound() const { return bound_; }
  std::int64_t open() const { return static_cast<std::int64_t>(rank_.nodes().frontier.open()); }

 private:
  static SolveOptions with(Omega omega) {
    SolveOptions options;
    options.omega = omega;
    options.techniques = {};  // plain CBS, for many nodes
    return options;
  }

  Instance instance_;
  SolveOptions options_;
  Limits limits_;
  Problem problem_;
  AgentStopsCache stops_;
  RunObserver observer_;
  testing::Outbox network_{0, 1};
  Rank rank_;
  Expander expander_;
  Cost bound_ = 0;
};

TEST(Rank, IsNotIdleIfItsNodesMayBeRequired) {
  for (const Cost excess : {-1, 1, 50}) {
    RankWithRoot rank(Omega(), excess);
    const auto status = rank.send_updates(0);
    ASSERT_TRUE(status);
    EXPECT_EQ(status->work_requests, (std::vector<message::WorkRequest>{{0, false, rank.bound()}}));
    EXPECT_TRUE(status->surplus.empty()) << "it has only one node";
  }
}

TEST(Rank, IsIdleIfAllNodesAreWithinOmegaOfTheIncumbent) {
  RankWithRoot rank(Omega::parse("0.5"), 1);
  const auto status = rank.send_updates(0);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->work_requests, (std::vector<message::WorkRequest>{{0, true, kInfiniteCost}}));
  EXPECT_TRUE(status->surplus.empty());
  EXPECT_TRUE(status->live) << "its nodes still count";
  EXPECT_EQ(status->bound, rank.bound());
  EXPECT_EQ(status->open, 1);
}

TEST(Rank, ReportsALargeSurplusAtOnce) {
  RankWithRoot rank(Omega(), -1);
  const auto first = rank.send_updates(0);
  ASSERT_TRUE(first);
  std::int64_t reported = first->open;
  int statuses = 0;
  int expansions = 0;
  while (rank.open() < 200 && expansions < 5000 && rank.expand()) {
    ++expansions;
    if (const auto status = rank.send_updates(0)) {
      ++statuses;
      reported = status->open;
    }
    EXPECT_LE(rank.open() / 2, 2 * (reported / 2));
  }
  EXPECT_GE(rank.open(), 200) << "too few nodes to test anything";
  EXPECT_LT(statuses, expansions / 2) << "small changes are reported later";
}

}  // namespace rank_test
}  // namespace grove::detail
