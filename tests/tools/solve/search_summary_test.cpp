// SPDX-License-Identifier: MIT
#include "tools/solve/search_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grove::detail {
namespace search_summary_test {

using ::testing::Contains;
using ::testing::Each;
using ::testing::EndsWith;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

TEST(SearchSummary, IsEmptyWithoutASearch) {
  EXPECT_THAT(search_summary({}), IsEmpty());
}

TEST(SearchSummary, ListsTheCounts) {
  Stats stats;
  stats.counts = {{"nodes_expanded", 7},
                  {"nodes_generated", 15},
                  {"roots_generated", 1},
                  {"splits_cost", 2},
                  {"splits_vertex_edge", 5},
                  {"bypasses", 3},
                  {"branching_cost_queries", 8},
                  {"branching_cost_hits", 6},
                  {"plans_start", 1},
                  {"plans_lns", 4},
                  {"gain_lns", 9}};
  const auto lines = search_summary(stats);
  EXPECT_THAT(lines, Contains("Nodes         expanded 7, generated 15, trees 1"));
  EXPECT_THAT(lines, Contains("Splits        vertex-edge 5, cost 2; 3 bypasses"));
  EXPECT_THAT(lines, Contains(EndsWith("8 queries, 75 % cache hits")));
  EXPECT_THAT(lines, Contains(EndsWith("0 queries, 0 % cache hits")));  // MDDs without queries
  EXPECT_THAT(lines, Contains("Incumbents    start 1, lns 4 (cost -9)"));
}

TEST(SearchSummary, NamesTheCountersOfChoices) {
  Stats stats;
  stats.counts = {{"nodes_expanded", 1}};
  EXPECT_THAT(search_summary(stats), Each(Not(StartsWith("Cores"))));
  stats.counts["assignments"] = 3;
  EXPECT_THAT(search_summary(stats),
              Contains("Cores         0 cores, 0 conflicts of the SAT solver, 0 of paths"));
  stats.counts["cores"] = 4;
  stats.counts["cores_conflicts"] = 1988;
  stats.counts["cores_path_conflicts"] = 5;
  const auto lines = search_summary(stats);
  EXPECT_THAT(lines, Contains("Choices       assignments searched one after the other: 3"));
  EXPECT_THAT(lines,
              Contains("Cores         4 cores, 1988 conflicts of the SAT solver, 5 of paths"));
}

}  // namespace search_summary_test
}  // namespace grove::detail
