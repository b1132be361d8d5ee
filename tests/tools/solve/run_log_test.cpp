// SPDX-License-Identifier: MIT
// Tests when the log of a run gets a row, on a clock that the test sets.
#include "tools/solve/run_log.h"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace grove::detail {
namespace run_log_test {

struct RecordedRows : LogFormat {
  void head(const LogHead&) override {}
  void warning(std::string_view) override {}
  void resumed(const CheckpointHeader&) override {}
  void row(const LogRow& row) override { rows.push_back(row); }
  void progress(const LogRow&) override { ++progress_lines; }
  void infeasible(std::string_view) override {}
  void note(std::string_view, double) override {}
  void checkpoint(const CheckpointReport&, double) override {}
  void end(const LogEnd&) override {}

  std::vector<LogRow> rows;
  int progress_lines = 0;
};

class RunLogTest : public ::testing::Test {
 protected:
  void wait(double seconds) {
    now_ +=
        std::chrono::duration_cast<RunLog::Clock::duration>(std::chrono::duration<double>(seconds));
  }
  RunLog::Options options() {
    RunLog::Options options;
    options.now = [this] { return now_; };
    return options;
  }
  static Progress at(std::int64_t nodes, Cost lower_bound) {
    return {nodes, 1, 1, lower_bound, {}};
  }

  RunLog::Clock::time_point now_;
  RecordedRows format_;
};

TEST_F(RunLogTest, ThrottledRowsFollowTheClock) {
  RunLog log(format_, now_, options());
  log.on_event(RunEvent::kBound, at(1, 5));
  const std::size_t first = format_.rows.size();
  for (int i = 2; i < 100; ++i) log.on_event(RunEvent::kBound, at(i, 5 + i));
  EXPECT_EQ(format_.rows.size(), first) << "no time passes";
  wait(100);
  log.on_event(RunEvent::kProgress, at(100, 104));
  ASSERT_EQ(format_.rows.size(), first + 1);
  EXPECT_EQ(format_.rows.back().event, RunEvent::kBound) << "the most important event since then";
  EXPECT_EQ(format_.rows.back().seconds, 100);
  wait(9);
  log.on_event(RunEvent::kProgress, at(200, 104));
  EXPECT_EQ(format_.rows.size(), first + 1) << "the interval grows with the elapsed time";
  wait(1.5);
  log.on_event(RunEvent::kProgress, at(300, 104));
  EXPECT_EQ(format_.rows.size(), first + 2);
}

TEST_F(RunLogTest, IncumbentGetsARowAtOnce) {
  RunLog log(format_, now_, options());
  for (int i = 0; i < 3; ++i) {
    log.on_incumbent({}, PlanSource::kLns, at(1, 5));
    log.on_event(RunEvent::kIncumbent, at(1, 5));
  }
  ASSERT_GE(format_.rows.size(), 3u);
  EXPECT_EQ(format_.rows.back().event, RunEvent::kIncumbent);
  EXPECT_EQ(format_.rows.back().source, PlanSource::kLns);
}

TEST_F(RunLogTest, RisesOfTheBoundAreAttributedToTheirCause) {
  RunLog log(format_, now_, options());
  log.on_event(RunEvent::kBound, at(0, 10));
  log.on_outside_bound(ComponentId::kLagrangian);
  log.on_event(RunEvent::kBound, at(1, 14));
  wait(100);
  log.on_event(RunEvent::kProgress, at(2, 14));
  Cost rise = 0;
  for (const LogRow& row : format_.rows)
    if (const auto found = row.raised_by.find("lagrangian"); found != row.raised_by.end())
      rise += found->second;
  EXPECT_EQ(rise, 4);
}

}  // namespace run_log_test
}  // namespace grove::detail
