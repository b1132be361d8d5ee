// SPDX-License-Identifier: MIT
#include "tools/solve/plan_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "io/plan_file.h"
#include "tests/support/instances.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace plan_output_test {

using ::testing::HasSubstr;

// An agent with a single route. Its path costs 2, or more if the agent waits first.
class PlanOutput : public ::testing::Test {
 protected:
  Solution waiting(Time steps) const {
    Solution solution;
    Path path(static_cast<std::size_t>(steps), 0);
    path.insert(path.end(), {0, 1, 2});
    solution.plan = Plan{2 + steps, {{2 + steps, {}, path}}};
    solution.lower_bound = 2;
    solution.status = status_of(solution.plan->cost, solution.lower_bound, solution.omega);
    return solution;
  }
  static Solution without_plan(Status status, Cost lower_bound) {
    Solution solution;
    solution.status = status;
    solution.lower_bound = lower_bound;
    return solution;
  }
  std::optional<Cost> write(const Solution& solution) const {
    return write_plan(directory_ / "p.json", instance_, solution);
  }
  std::string content() const { return file_content(directory_ / "p.json"); }
  std::string failure(const Solution& solution) const {
    try {
      write(solution);
    } catch (const std::logic_error& error) {
      return error.what();
    }
    return "none";
  }

  const Instance instance_ = testing::instance_of({"..."}, {{{0, 0}, Position{2, 0}}});
  TemporaryDirectory directory_;
};

TEST_F(PlanOutput, ReplacesPlansOfEqualOrHigherCost) {
  EXPECT_EQ(write(waiting(3)), std::nullopt);
  EXPECT_EQ(write(waiting(1)), std::nullopt);
  EXPECT_EQ(content(), solution_text(instance_, waiting(1)));
  Solution other = waiting(1);
  other.lower_bound = 1;  // written, although the bound in the file is higher
  EXPECT_EQ(write(other), std::nullopt);
  EXPECT_EQ(content(), solution_text(instance_, other));
}

TEST_F(PlanOutput, KeepsCheaperPlans) {
  write(waiting(1));
  EXPECT_EQ(write(waiting(2)), 3);
  EXPECT_EQ(write(without_plan(Status::kUnknown, 2)), 3);
  EXPECT_EQ(content(), solution_text(instance_, waiting(1)));
}

TEST_F(PlanOutput, ReplacesPlansOfAnotherInstance) {
  const Instance other = testing::instance_of({"...", "..."}, {{{0, 1}, Position{2, 1}}});
  Solution solution = waiting(0);
  for (Cell& cell : solution.plan->agents[0].path) cell += 3;
  write_plan(directory_ / "p.json", other, solution);
  EXPECT_EQ(write(without_plan(Status::kUnknown, 2)), std::nullopt);
  EXPECT_THAT(content(), HasSubstr("unknown"));
}

// The checker accepts the plan in the file, but the search claims that no such plan exists. They
// implement the rules independently, so one of them must be wrong.
TEST_F(PlanOutput, RefutesAFalseBoundByTheExistingPlan) {
  write(waiting(0));
  EXPECT_THAT(failure(without_plan(Status::kInfeasible, 0)),
              HasSubstr("claims that there is no plan"));
  EXPECT_THAT(failure(without_plan(Status::kUnknown, 3)), HasSubstr("no plan costs less than 3"));
  Solution wrong = waiting(1);
  wrong.lower_bound = 3;
  wrong.status = Status::kOptimal;
  EXPECT_THAT(failure(wrong), HasSubstr("has a valid plan of cost 2"));
  EXPECT_EQ(content(), solution_text(instance_, waiting(0)));
}

TEST_F(PlanOutput, ReportsKeptAndMissingPlans) {
  const auto output = [](const Solution& solution, std::optional<Cost> kept) {
    ::testing::internal::CaptureStderr();
    report_missing_plan(solution, "p.json", kept);
    return ::testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(output(waiting(1), {}), "");
  EXPECT_EQ(output(waiting(1), 2),
            "grove: the plan found costs 3 (feasible, lower bound 2); p.json keeps its valid plan "
            "of cost 2\n");
  EXPECT_EQ(output(without_plan(Status::kInfeasible, 0), {}),
            "grove: no plan was found (infeasible)\n");
}

}  // namespace plan_output_test
}  // namespace grove::detail
