// SPDX-License-Identifier: MIT
#include "tools/bench/run_outcome.h"

#include <gtest/gtest.h>

#include <csignal>

#include "io/plan_file.h"
#include "tests/support/instances.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail::bench {
namespace run_outcome_test {

using batch::Outcome;

class Judges : public ::testing::Test {
 protected:
  Judges() {
    solution_.status = Status::kOptimal;
    solution_.lower_bound = 3;
    solution_.plan = Plan{3, {AgentPlan{3, {0}, path({0, 1, 2, 3})}}};
    solution_.stats.measures = {{"peak_memory_mb", 5.5}};
    solution_.stats.texts = {{"version", "grove 9"}};
  }
  Path path(const std::vector<int>& xs) const {
    Path cells;
    for (const int x : xs) cells.push_back(instance_.grid().cell({x, 0}));
    return cells;
  }
  Outcome verdict(const ChildEnd& end = {}) {
    write_solution(directory_ / "plan", instance_, solution_);
    return verdict_on_what_is_there(end);
  }
  Outcome verdict_on_what_is_there(const ChildEnd& end = {}) {
    return outcome_of_run(end, 60, instance_, directory_ / "plan", directory_ / "said");
  }

  const Instance instance_ =
      grove::detail::testing::instance_of({"...."}, {{{0, 0}, Position{3, 0}, {{1, 0}}}});
  Solution solution_;
  TemporaryDirectory directory_;
};

TEST_F(Judges, AcceptCheckedPlans) {
  EXPECT_EQ(verdict(), batch::outcome_of(instance_, solution_));
  EXPECT_TRUE(verdict().solved);
}

TEST_F(Judges, CountPlansAfterTheTimeLimitAsUnsolved) {
  EXPECT_TRUE(verdict({ChildEnd::Kind::kExited, 0, 60}).solved);
  const Outcome late = verdict({ChildEnd::Kind::kExited, 0, 60.01});
  EXPECT_EQ(late.status, "optimal");
  EXPECT_FALSE(late.solved);
  EXPECT_EQ(late.error, "time limit");
}

TEST_F(Judges, RefuseInvalidPlans) {
  std::string text = solution_text(instance_, solution_);
  text.replace(text.find("[2,0]"), 5, "[3,0]");
  directory_.write("plan", text);
  const Outcome outcome = verdict_on_what_is_there();
  EXPECT_TRUE(outcome.failed());
  EXPECT_FALSE(outcome.solved);
  EXPECT_EQ(outcome.cost, std::nullopt);
  EXPECT_TRUE(outcome.error.starts_with("the plan is wrong: /agents/0/path/2")) << outcome.error;
}

TEST_F(Judges, ReportTheCauseOfAFailure) {
  directory_.write("said", "grove: warning: odd\ngrove: error: broken\n");
  EXPECT_EQ(verdict({ChildEnd::Kind::kExited, 2, 1}).error, "ended with exit code 2: broken");
  EXPECT_EQ(verdict({ChildEnd::Kind::kSignalled, SIGKILL, 1}).error, "ended by signal 9 (Killed)");
  EXPECT_EQ(verdict({ChildEnd::Kind::kTooLong, SIGKILL, 76.4}).error,
            "did not end; killed after 76 s");
  EXPECT_TRUE(verdict({ChildEnd::Kind::kTooLong, SIGKILL, 76.4}).failed());
  directory_.write("plan", "{");
  const Outcome outcome =
      outcome_of_run({}, 60, instance_, directory_ / "plan", directory_ / "said");
  EXPECT_TRUE(outcome.failed());
  EXPECT_TRUE(outcome.error.starts_with("the plan file is wrong: ")) << outcome.error;
  EXPECT_TRUE(outcome_of_run({}, 60, instance_, directory_ / "none", directory_ / "none").failed());
}

}  // namespace run_outcome_test
}  // namespace grove::detail::bench
