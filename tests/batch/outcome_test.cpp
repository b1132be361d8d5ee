// SPDX-License-Identifier: MIT
#include "batch/outcome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/instances.h"

namespace grove::detail::batch {
namespace outcome_test {

class Outcomes : public ::testing::Test {
 protected:
  Outcomes() {
    solution_.status = Status::kOptimal;
    solution_.lower_bound = 3;
    solution_.plan = Plan{3, {AgentPlan{3, {0}, path({0, 1, 2, 3})}}};
    solution_.stats.counts = {{"roots_generated", 1}, {"rtsp_calls", 2}, {"nodes_expanded", 3},
                              {"low_level_calls", 4}, {"bypasses", 6},   {"splits_vertex_edge", 7},
                              {"restarts", 0},        {"threads", 2}};
    solution_.stats.measures = {{"peak_memory_mb", 5.5}};
    solution_.stats.texts = {{"version", "grove 9"}};
  }
  Path path(const std::vector<int>& xs) const {
    Path cells;
    for (const int x : xs) cells.push_back(instance_.grid().cell({x, 0}));
    return cells;
  }
  Outcome outcome() const { return outcome_of(instance_, solution_); }

  const Instance instance_ =
      grove::detail::testing::instance_of({"...."}, {{{0, 0}, Position{3, 0}, {{1, 0}}}});
  Solution solution_;
};

TEST_F(Outcomes, HoldTheCheckedSolution) {
  EXPECT_EQ(outcome(), (Outcome{.status = "optimal",
                                .solved = true,
                                .cost = 3,
                                .lower_bound = 3,
                                .roots = 1,
                                .rtsp_calls = 2,
                                .nodes = 3,
                                .low_level_calls = 4,
                                .peak_memory_mb = 5.5,
                                .counts = "bypasses=6 splits_vertex_edge=7",
                                .version = "grove 9"}));
}

TEST_F(Outcomes, CountAPlanAtALimitAsUnsolved) {
  solution_.status = Status::kFeasible;
  solution_.lower_bound = 2;
  solution_.stats.texts["stopped_by"] = "time limit";
  EXPECT_EQ(outcome().status, "feasible");
  EXPECT_FALSE(outcome().solved);
  EXPECT_EQ(outcome().error, "time limit");
  EXPECT_EQ(outcome().cost, 3);
  EXPECT_EQ(outcome().lower_bound, 2);
}

TEST_F(Outcomes, CountAPlanOutsideOmegaAsSolvedWithoutALimit) {
  solution_.status = Status::kFeasible;
  solution_.lower_bound = 2;
  solution_.omega = Omega::infinite();
  EXPECT_TRUE(outcome().solved);
}

TEST_F(Outcomes, AcceptNoPlanOnlyIfInfeasibleOrUnknown) {
  solution_.plan.reset();
  solution_.status = Status::kInfeasible;
  EXPECT_EQ(outcome().status, "infeasible");
  EXPECT_FALSE(outcome().solved);
  EXPECT_EQ(outcome().lower_bound, std::nullopt);
  solution_.status = Status::kUnknown;
  EXPECT_EQ(outcome().status, "unknown");
  EXPECT_EQ(outcome().lower_bound, 3);
  solution_.status = Status::kOptimal;
  EXPECT_TRUE(outcome().failed());
}

TEST_F(Outcomes, RefuseWrongPlans) {
  solution_.plan->agents[0].path = path({0, 1, 3, 3});
  EXPECT_TRUE(outcome().failed());
  EXPECT_FALSE(outcome().solved);
  EXPECT_EQ(outcome().cost, std::nullopt);
  EXPECT_TRUE(outcome().error.starts_with("the plan is wrong: /agents/0/path/2"))
      << outcome().error;

  solution_.plan->agents[0].path = path({0, 1, 2, 3});
  solution_.plan->cost = 4;
  EXPECT_TRUE(outcome().failed());
  solution_.plan->cost = 3;
  solution_.lower_bound = 2;  // contradicts the status `optimal`
  EXPECT_TRUE(outcome().failed());
}

TEST_F(Outcomes, AreInterruptedIfStoppedByAnInterrupt) {
  EXPECT_FALSE(outcome().interrupted());
  solution_.stats.texts["stopped_by"] = "interrupt";
  EXPECT_TRUE(outcome().interrupted());
  EXPECT_FALSE(outcome().solved);
}

TEST(Traces, RoundTripAsText) {
  const std::vector<TracePoint> trace{{0.25, 120, 100}, {1.5, 118, std::nullopt}, {2, 0, 0}};
  EXPECT_EQ(trace_text(trace), "0.25:120:100 1.5:118:- 2:0:0");
  EXPECT_EQ(parse_trace(trace_text(trace)), trace);
  EXPECT_EQ(trace_text({}), "");
  EXPECT_TRUE(parse_trace("").empty());
  EXPECT_EQ(trace_text({{1.0 / 3, 1, {}}}), "0.333333:1:-");
  for (const char* text : {"1", "1:2", "1:2:", "1:2:3:4", "a:2:3", "1:b:-", "-1:2:3", "1:-2:3"})
    EXPECT_THROW(parse_trace(text), std::invalid_argument) << text;
}

TEST(Traces, KeepTheirEndsWhenThinnedOut) {
  std::vector<TracePoint> trace;
  for (int k = 0; k < 1000; ++k) trace.push_back({1.0 * k, 5000 - k, {}});
  const auto whole = trace;
  thin_out(trace, 1000);
  EXPECT_EQ(trace, whole);
  thin_out(trace, 200);
  EXPECT_LE(trace.size(), 200u);
  EXPECT_GE(trace.size(), 100u);
  EXPECT_EQ(trace.front(), whole.front());
  EXPECT_EQ(trace.back(), whole.back());
  EXPECT_TRUE(std::ranges::is_sorted(trace, {}, &TracePoint::seconds));
}

}  // namespace outcome_test
}  // namespace grove::detail::batch
