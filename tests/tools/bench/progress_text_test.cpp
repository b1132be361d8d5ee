// SPDX-License-Identifier: MIT
#include "tools/bench/progress_text.h"

#include <gtest/gtest.h>

#include "tests/support/result_rows.h"

namespace grove::detail::bench {
namespace progress_text_test {

using batch::Row;
using grove::detail::testing::failed_row;
using grove::detail::testing::solved_row;

BenchState counted() {
  BenchState state{.methods = {"auto", "paper"}, .counts = {{"auto", {}}, {"paper", {}}}};
  state.work.left = 10;
  state.work.workers = 2;
  state.elapsed_s = 65;
  for (const double wall_s : {3.0, 1.0, 4.0}) {
    Row row = solved_row("i", "auto");
    row.wall_s = wall_s;
    state.count(row);
  }
  Row failed = failed_row("i", "paper");
  failed.wall_s = 2;
  state.count(failed);
  return state;
}

TEST(BenchProgress, ShowsProgressAndSolvedCounts) {
  EXPECT_EQ(progress_text(counted()).line,
            "4/10 done; 1:05 elapsed, about 0:08 left; solved: auto 3/3, paper 0/1; 1 error");
  EXPECT_EQ(progress_text(counted()).done, 4);
  EXPECT_EQ(progress_text(counted()).total, 10);
}

TEST(BenchSummary, CountsUnsolvedRunsAsTheTimeLimit) {
  BenchState state = counted();
  EXPECT_EQ(summary_table(state),
            "method  solved/run  median s  errors\n"
            "auto           3/3      3.00       0\n"
            "paper          0/1     60.00       1\n"
            "median s: over all runs; a run that is not solved counts as its time limit\n");
  Row row = solved_row("i", "auto");
  row.wall_s = 5;
  state.count(row);
  EXPECT_NE(summary_table(state).find("4/4      3.50"), std::string::npos) << summary_table(state);
}

TEST(BenchSummary, ShowsOtherOutcomesOnlyIfPresent) {
  BenchState state = counted();
  for (const char* status :
       {batch::kInvalidPlan, batch::kClaimed, batch::kClaimed, batch::kUnsupported}) {
    Row row = failed_row("i", "paper");
    row.outcome.status = status;
    state.count(row);
  }
  state.false_claims.assign(12, {"paper", "i", "claims a cost of 60, but its own paths cost 64"});
  const std::string said = summary_table(state);
  EXPECT_TRUE(said.starts_with(
      "method  solved/run  median s  errors  invalid  claimed  refuted  unsupported\n"
      "auto           3/3      3.00       0        0        0        0            0\n"
      "paper          0/4     60.00       1        1        2       12            1\n"))
      << said;
  EXPECT_NE(said.find("\nrefuted: paper on i claims a cost of 60, but its own paths cost 64\n"),
            std::string::npos);
  EXPECT_TRUE(said.ends_with("\nrefuted: 2 more; grove report lists all\n"));
}

}  // namespace progress_text_test
}  // namespace grove::detail::bench
