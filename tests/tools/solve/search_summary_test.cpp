// SPDX-License-Identifier: MIT
#include "tools/solve/search_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grove::detail {
namespace search_summary_test {

using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::IsEmpty;

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

}  // namespace search_summary_test
}  // namespace grove::detail
