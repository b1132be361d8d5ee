// SPDX-License-Identifier: MIT
#include "batch/result_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "tests/support/refusal.h"
#include "tests/support/result_rows.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail::batch {
namespace result_table_test {

namespace fs = std::filesystem;

using grove::detail::testing::failed_row;
using grove::detail::testing::solved_row;
using Positions = std::vector<std::size_t>;

class Tables : public ::testing::Test {
 protected:
  static std::vector<batch::Run> runs_of(const std::vector<Row>& rows) {
    std::vector<batch::Run> runs;
    for (const Row& row : rows) runs.push_back(row.run);
    return runs;
  }
  std::vector<batch::Run> runs() const { return runs_of(rows_); }
  std::string file() const { return folder_ + "/results.jsonl"; }
  std::string lines() const { return file_content(file()); }
  // Returns the expected file contents after the rows at `positions` were appended.
  std::string lines_of(const Positions& positions) const {
    std::string text;
    for (const std::size_t i : positions) text += json_line(rows_[i]) + "\n";
    return text;
  }
  ResultTable open() const { return ResultTable(folder_, what_); }
  // Simulates an earlier command that completed the runs at `done` and was then killed.
  void run(const Positions& done) {
    ResultTable table = open();
    table.begin(runs());
    for (const std::size_t i : done) table.append({&rows_[i], 1});
  }
  Positions left() const { return open().begin(runs()); }
  std::string refused() const {
    return refusal([&] { left(); });
  }
  // Returns the message of the refusal after `change` has been applied to the run of row 1.
  std::string refused_after(const std::function<void(batch::Run&)>& change) {
    const batch::Run before = rows_[1].run;
    change(rows_[1].run);
    const std::string message = refused();
    rows_[1].run = before;
    return message;
  }

  TemporaryDirectory directory_;
  const std::string folder_ = directory_ / "out/deep";
  // The rows for a command that solves two instances by two methods.
  std::vector<Row> rows_{solved_row("i", "a"), solved_row("i", "b"), solved_row("j", "a"),
                         solved_row("j", "b")};
  TableOf what_ = TableOf::kMethods;
};

TEST_F(Tables, AreEmptyAtFirst) {
  EXPECT_EQ(left(), (Positions{0, 1, 2, 3}));
  EXPECT_EQ(lines(), "");
  EXPECT_EQ(left(), (Positions{0, 1, 2, 3}));
}

TEST_F(Tables, ResumeWhereTheyStopped) {
  run({2, 0});
  EXPECT_EQ(left(), (Positions{1, 3}));
  EXPECT_EQ(lines(), lines_of({2, 0}));
  run({1, 3});
  EXPECT_EQ(left(), Positions());
  EXPECT_EQ(lines(), lines_of({2, 0, 1, 3}));
  const ResultTable table = open();
  EXPECT_EQ(table.rows(), (std::vector{rows_[2], rows_[0], rows_[1], rows_[3]}));
  ASSERT_NE(table.find(rows_[1].run), nullptr);
  EXPECT_EQ(*table.find(rows_[1].run), rows_[1]);
  EXPECT_EQ(table.find(solved_row("k", "a").run), nullptr);
}

// The last write can be cut off at any byte.
TEST_F(Tables, RemoveATruncatedLastLine) {
  run({0, 1});
  const std::string line = lines_of({1});
  for (std::size_t size = 1; size < line.size(); size += size + 29 < line.size() ? 29 : 1) {
    std::ofstream(file()) << lines_of({0}) << line.substr(0, size);
    ASSERT_EQ(left(), (Positions{1, 2, 3})) << size;
    ASSERT_EQ(lines(), lines_of({0})) << size;
  }
  std::ofstream(file()) << lines_of({0}) << line.substr(0, 20);
  run({3});
  EXPECT_EQ(lines(), lines_of({0, 3}));
}

TEST_F(Tables, RepeatFailedRuns) {
  const Row good = rows_[1];
  rows_[1] = failed_row("i", "b");
  run({0, 1});
  rows_[1] = good;  // the failed run is repeated even with different limits
  EXPECT_EQ(left(), (Positions{1, 2, 3}));
  EXPECT_EQ(lines(), lines_of({0}));
}

TEST_F(Tables, RepeatRunsWhosePlanFileIsMissing) {
  rows_[1].plan_file = "plan";
  run({0, 1, 2, 3});
  EXPECT_EQ(left(), Positions{1});
  std::ofstream(folder_ + "/plan") << "{}";
  run({1});
  EXPECT_EQ(left(), Positions());
}

TEST_F(Tables, RefuseRowsOfOtherRuns) {
  run({0, 1});
  const auto expect = [&](const std::function<void(batch::Run&)>& change, const std::string& text) {
    const std::string message = refused_after(change);
    EXPECT_NE(message.find("another run of b on i (" + text), std::string::npos) << message;
  };
  expect([](batch::Run& run) { run.settings.options = "--omega 0"; },
         "options '--omega 0.01' there, '--omega 0' here)");
  expect([](batch::Run& run) { run.settings.omega = "0"; }, "omega '0.01' there, '0' here)");
  expect([](batch::Run& run) { run.settings.time_limit_s = 0.5; },
         "time limit '60' there, '0.5' here)");
  expect([](batch::Run& run) { run.settings.memory_limit_gb.reset(); },
         "memory limit '1.5 GB' there, 'by the machine' here)");
  expect([](batch::Run& run) { run.digest = "x"; }, "the instance or its map has changed");
  EXPECT_EQ(left(), (Positions{2, 3}));
  EXPECT_EQ(lines(), lines_of({0, 1}));
}

TEST_F(Tables, HoldARowForEachSeed) {
  run({0, 1, 2, 3});
  rows_[1].run.settings.seed = 8;
  EXPECT_EQ(left(), Positions{1});
  run({1});
  EXPECT_EQ(left(), Positions());
  EXPECT_EQ(open().rows().size(), 5U);
}

// A table of plans repeats a run if its instance has changed.
TEST_F(Tables, OfPlansRepeatRunsOfChangedInstances) {
  what_ = TableOf::kPlans;
  rows_ = {solved_row("i"), solved_row("j"), solved_row("k")};
  run({0, 1});
  rows_[1].run.digest = "another";
  EXPECT_EQ(left(), (Positions{1, 2}));
  EXPECT_EQ(lines(), lines_of({0}));
}

// All rows of a table of plans must have the same settings, including rows of instances that are
// not in the command.
TEST_F(Tables, OfPlansRefuseOtherSettings) {
  what_ = TableOf::kPlans;
  rows_ = {solved_row("i"), solved_row("j")};
  run({0, 1});
  const auto refused_to = [&](const std::function<void(Settings&)>& change) {
    std::vector<batch::Run> others{solved_row("k").run};
    change(others[0].settings);
    return refusal([&] { open().begin(others); });
  };
  EXPECT_EQ(refused_to([](Settings& settings) { settings.seed = 8; }),
            "results.jsonl: has a row of another run of auto on i (seed '7' there, '8' here); "
            "expected the same run; use another folder, or delete the row");
  EXPECT_NE(refused_to([](Settings& settings) {
              settings.method = "hcbs";
            }).find("method 'auto' there, 'hcbs' here"),
            std::string::npos);
  EXPECT_EQ(refused_to([](Settings&) {}), "accepted");
  EXPECT_EQ(lines(), lines_of({0, 1}));
}

TEST_F(Tables, KeepRowsThatTheCommandDoesNotName) {
  run({0, 1, 2});
  rows_ = {solved_row("j", "c"), solved_row("i", "b"), solved_row("k", "c")};
  EXPECT_EQ(left(), (Positions{0, 2}));
  EXPECT_EQ(open().rows().size(), 3U);
}

TEST_F(Tables, RefuseInvalidLines) {
  run({0, 1});
  std::ofstream(file(), std::ios::app) << "\nnonsense\n";
  EXPECT_TRUE(
      refused().starts_with("results.jsonl: line 4: expected a row of this version; use another "
                            "folder, or delete the line to repeat the run ("))
      << refused();
}

// Two rows for one run can result from merging two files by hand.
TEST_F(Tables, KeepTheLastRowOfAPair) {
  run({0, 1});
  rows_[0].wall_s = 99;
  std::ofstream(file(), std::ios::app) << "\n" << lines_of({0}) << "\n";
  EXPECT_EQ(left(), (Positions{2, 3}));
  EXPECT_EQ(lines(), lines_of({1, 0}));
  EXPECT_EQ(open().find(rows_[0].run)->wall_s, 99);
}

TEST_F(Tables, RefuseASecondRow) {
  ResultTable table = open();
  table.begin(runs());
  table.append({&rows_[0], 1});
  EXPECT_THROW(table.append({&rows_[0], 1}), std::logic_error);
  EXPECT_EQ(lines(), lines_of({0}));
}

TEST_F(Tables, AreLockedForOneRun) {
  const ResultTable table = open();
  EXPECT_EQ(refused(),
            "deep: is in use by another run; expected a folder that no other run writes to");
}

TEST_F(Tables, NeedAWritableFolder) {
  directory_.write("file", "");
  EXPECT_NE(refusal([&] { ResultTable(directory_ / "file", what_); }).find("cannot be made"),
            std::string::npos);
}

TEST_F(Tables, AreWrittenAsCsvInTheOrderOfTheCommand) {
  run({3, 1});
  const Row other = rows_[3];
  rows_.pop_back();
  ResultTable table = open();
  table.begin(runs());
  table.append({&rows_[0], 1});
  table.write_csv();
  EXPECT_EQ(file_content(folder_ + "/results.csv"),
            csv_header() + csv_line(rows_[0]) + csv_line(rows_[1]) + csv_line(other));
}

// A run during which the program was killed is repeated after all other runs.
TEST_F(Tables, PutRunsThatNeverEndedLast) {
  rows_ = {solved_row("a"), solved_row("b"), solved_row("c"), solved_row("d")};
  {
    ResultTable table = open();
    for (const std::size_t i : table.begin(runs())) table.mark_started(rows_[i].run);
    table.append({&rows_[1], 1});
  }
  std::ofstream(folder_ + "/.begun", std::ios::app) << "torn";
  rows_.push_back(solved_row("e"));
  {
    ResultTable table = open();
    EXPECT_EQ(table.begin(runs()), (Positions{4, 0, 2, 3}));
    table.mark_started(rows_[4].run);
    table.mark_started(rows_[0].run);
    table.append({&rows_[4], 1});
  }
  EXPECT_EQ(left(), (Positions{2, 3, 0}));
  {
    ResultTable table = open();
    table.begin(runs());
    table.end();
  }
  EXPECT_EQ(left(), (Positions{0, 2, 3}));
}

}  // namespace result_table_test
}  // namespace grove::detail::batch
