// SPDX-License-Identifier: MIT
#include "sequencing/k_best_joint_sequences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <set>

#include "brute_force.h"
#include "matrices.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail::testing {
namespace k_best_joint_sequences_test {

// The cost matrices of the agents, in a deque because solvers keep references to them.
struct Agents {
  std::deque<CostMatrix> matrices;
  Limits limits;

  KBestJointSequences joint(RtspBackend backend) {
    std::vector<KBestSequences> lists;
    for (const CostMatrix& matrix : matrices)
      lists.emplace_back(make_rtsp_solver(backend, matrix, limits), matrix, limits);
    return {std::move(lists), limits};
  }

  // Returns the least `count` costs of all combinations, in ascending order.
  std::vector<Cost> product(std::size_t count) const {
    std::vector<Cost> sums{0};
    for (const CostMatrix& matrix : matrices) {
      std::vector<Cost> next;
      for (Time cost : all_costs(matrix, {}))
        for (Cost sum : sums) next.push_back(sum + cost);
      std::sort(next.begin(), next.end());
      if (next.size() > count) next.resize(count);  // larger sums cannot contribute
      sums = next;
    }
    return sums;
  }
};

// Returns the costs of the first joint sequences, at most `count`. Checks all guarantees of
// KBestJointSequences.
std::vector<Cost> first_costs(Agents& agents, RtspBackend backend, std::size_t count) {
  KBestJointSequences joint = agents.joint(backend);
  std::vector<Cost> costs;
  std::set<std::vector<std::uint32_t>> seen;
  while (costs.size() < count) {
    const Cost bound = joint.lower_bound();
    const auto next = joint.next();
    if (!next) {
      EXPECT_EQ(joint.lower_bound(), kInfiniteCost);
      break;
    }
    EXPECT_LE(bound, next->cost);
    EXPECT_GE(joint.lower_bound(), next->cost);
    EXPECT_TRUE(seen.insert(next->ranks).second) << "a vector twice";
    Cost sum = 0;
    for (std::size_t i = 0; i < agents.matrices.size(); ++i)
      sum += sequence_cost(agents.matrices[i],
                           joint.sequence(static_cast<AgentIndex>(i), next->ranks[i]));
    EXPECT_EQ(sum, next->cost);
    if (!costs.empty()) {
      EXPECT_GE(next->cost, costs.back());
    }
    costs.push_back(next->cost);
  }
  return costs;
}

// Lists with 1 to 120 sequences, enumerated completely if there are at most 1,500 combinations.
TEST(KBestJointSequences, EqualsTheProductOfTheLists) {
  Random random(21);
  for (int round = 0; round < fuzz_rounds(12); ++round)
    for (RtspBackend backend : {RtspBackend::kHeldKarp, RtspBackend::kBoundedDp}) {
      Agents agents;
      for (int i = 1 + static_cast<int>(random() % 4); i > 0; --i)
        agents.matrices.push_back(
            metric_matrix(static_cast<int>(random() % 6), kVariants[random() % 2], random));
      ASSERT_EQ(first_costs(agents, backend, 1500), agents.product(1500));
    }
}

TEST(KBestJointSequences, AgreesThroughCbc) {
  if (!is_built(RtspBackend::kCbc)) GTEST_SKIP() << "built without CBC";
  Random random(22);
  Agents agents;
  for (int n : {2, 4, 0, 3}) agents.matrices.push_back(grid_matrix(n, Variant::kCts, random));
  ASSERT_EQ(first_costs(agents, RtspBackend::kCbc, 100), agents.product(100));
}

// The list of the second agent ends first. All 2 * 6 combinations of the other lists must still
// follow.
TEST(KBestJointSequences, ListsAllCombinationsWhenAListEnds) {
  Random random(23);
  Agents agents;
  for (int n : {2, 1, 3}) agents.matrices.push_back(metric_matrix(n, Variant::kCts, random));
  EXPECT_EQ(first_costs(agents, RtspBackend::kHeldKarp, 100).size(), 12u);
}

TEST(KBestJointSequences, EndsAfterOneWhenNoAgentHasTasks) {
  Random random(24);
  Agents agents;
  for (int i = 0; i < 250; ++i) agents.matrices.push_back(metric_matrix(0, Variant::kCts, random));
  EXPECT_EQ(first_costs(agents, RtspBackend::kAuto, 10).size(), 1u);
}

TEST(KBestJointSequences, ServesHundredsOfAgents) {
  Random random(25);
  Agents agents;
  for (int i = 0; i < 220; ++i)
    agents.matrices.push_back(metric_matrix(i % 5, Variant::kCts, random));
  EXPECT_EQ(first_costs(agents, RtspBackend::kAuto, 400), agents.product(400));
}

TEST(KBestJointSequences, IsEmptyWhenOneAgentHasNoSequence) {
  Random random(26);
  Agents agents;
  for (int i = 0; i < 3; ++i) agents.matrices.push_back(metric_matrix(3, Variant::kCts, random));
  fill_column(agents.matrices[1], 0, kNever);
  KBestJointSequences joint = agents.joint(RtspBackend::kAuto);
  EXPECT_FALSE(joint.next());
  EXPECT_EQ(joint.lower_bound(), kInfiniteCost);
}

TEST(KBestJointSequences, CountsSolvedRtsps) {
  Random random(27);
  Agents agents;
  for (int n : {3, 4}) agents.matrices.push_back(metric_matrix(n, Variant::kCts, random));
  KBestJointSequences joint = agents.joint(RtspBackend::kAuto);
  EXPECT_EQ(joint.rtsp_calls(), 0);
  ASSERT_TRUE(joint.next());
  EXPECT_GE(joint.rtsp_calls(), 2);
}

}  // namespace k_best_joint_sequences_test
}  // namespace grove::detail::testing
