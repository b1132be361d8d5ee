// SPDX-License-Identifier: MIT
#include "search/path_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "search/problem.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace path_planner_test {

using testing::instance_of;

using Sequences = std::multiset<std::vector<int>>;

// One agent among obstacles, whose sequence class is split repeatedly.
class SplitClasses : public ::testing::TestWithParam<bool> {
 protected:
  static Instance instance(bool has_destination) {
    const std::optional<Position> destination =
        has_destination ? std::optional(Position{5, 4}) : std::nullopt;
    return instance_of({"......", ".@.@..", "......", "..@@..", "......"},
                       {{{0, 0}, destination, {{5, 0}, {0, 4}, {2, 2}, {4, 3}}}});
  }
  // Cost of a cheapest path, or kNever if there is no path.
  Time cost(const std::vector<Constraint>& constraints) {
    const auto outcome = planner_.find(0, open_, {.constraints = constraints}, Limits(), path_);
    EXPECT_NE(outcome, PathOutcome::kStopped);
    return outcome == PathOutcome::kFound ? static_cast<Time>(path_.size()) - 1 : kNever;
  }
  std::vector<Constraint> random_constraints(std::mt19937& random) const {
    std::vector<Constraint> constraints;
    for (auto count = random() % 12; count > 0; --count) {
      const auto time = static_cast<Time>(random() % 25);
      constraints.push_back({static_cast<Cell>(1 + random() % 28), kNoCell, time,
                             time + static_cast<Time>(random() % 4)});
    }
    return constraints;
  }
  // Splits down to single sequences. The branches of every split must hold all of the class that
  // was split, and no more.
  void split(std::vector<Constraint> constraints, Sequences& sequences) {
    const Time whole = cost(constraints);
    if (whole == kNever) return;
    const Sequence now = planner_.sequence(0, open_, constraints, path_);
    const auto branches = planner_.sequence_split(0, open_, constraints, path_);
    if (!branches) {
      sequences.emplace(now.begin(), now.end());
      return;
    }
    Time best = kNever;
    for (const AgentConstraint& branch : *branches) {
      constraints.push_back(branch.constraint);
      const Time part = cost(constraints);
      if (branch.constraint.kind == ConstraintKind::kStopIs) {
        EXPECT_EQ(part, whole);
      }
      best = std::min(best, part);
      split(constraints, sequences);
      constraints.pop_back();
    }
    EXPECT_EQ(best, whole);
  }

  Instance instance_ = instance(GetParam());
  Problem problem_{instance_, Limits()};
  AgentStopsCache stops_{instance_, problem_.distances};
  PathPlanner planner_{problem_, stops_};
  AgentSequencing open_{{}, std::nullopt, PackedPath()};
  Path path_;
};

TEST_P(SplitClasses, HoldEverySequenceOnce) {
  Sequences sequences;
  split({}, sequences);
  EXPECT_EQ(sequences.size(), 24u);
  EXPECT_EQ(std::set(sequences.begin(), sequences.end()).size(), 24u);
}

TEST_P(SplitClasses, KeepACheapestPathUnderRandomConstraints) {
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    Sequences sequences;
    split(random_constraints(random), sequences);
  }
}

INSTANTIATE_TEST_SUITE_P(Agents, SplitClasses, ::testing::Bool(), [](const auto& agent) {
  return agent.param ? "WithADestination" : "WithoutOne";
});

}  // namespace path_planner_test
}  // namespace grove::detail
