// SPDX-License-Identifier: MIT
#include "tools/bench/result_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "rows.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::bench {
namespace result_table_test {

using Positions = std::vector<std::size_t>;

class BenchTables : public ::testing::Test {
 protected:
  // The runs of a command on two instances by two methods, and their rows.
  std::vector<Row> rows_{solved_row("i", "a"), solved_row("i", "b"), solved_row("j", "a"),
                         solved_row("j", "b")};

  std::vector<RunIdentity> runs() const {
    std::vector<RunIdentity> runs;
    for (const Row& row : rows_) runs.push_back(row.run);
    return runs;
  }
  std::string folder() const { return directory_ / "results"; }
  std::string file() const { return folder() + "/results.jsonl"; }
  // An earlier command that did the runs at `done`.
  void run(const Positions& done) {
    ResultTable table(folder());
    table.begin(runs());
    for (const std::size_t i : done) table.append(rows_[i]);
  }
  Positions left() const { return ResultTable(folder()).begin(runs()); }
  std::string refused() const {
    return refusal([&] { left(); });
  }

  TemporaryDirectory directory_;
};

TEST_F(BenchTables, GoOnWhereTheyStopped) {
  EXPECT_EQ(left(), (Positions{0, 1, 2, 3}));
  run({2, 0});
  EXPECT_EQ(left(), (Positions{1, 3}));
  run({1, 3});
  EXPECT_EQ(left(), Positions());
  EXPECT_EQ(file_content(file()), json_line(rows_[2]) + "\n" + json_line(rows_[0]) + "\n" +
                                      json_line(rows_[1]) + "\n" + json_line(rows_[3]) + "\n");
}

TEST_F(BenchTables, MendATornLine) {
  run({0, 1});
  const std::string text = file_content(file());
  for (std::size_t cut = 1; cut < json_line(rows_[1]).size(); cut += 50) {
    directory_.write("results/results.jsonl", text.substr(0, text.size() - cut));
    EXPECT_EQ(left(), (Positions{1, 2, 3}));
    EXPECT_EQ(file_content(file()), json_line(rows_[0]) + "\n");
  }
}

TEST_F(BenchTables, RunErrorsAgain) {
  const Row good = rows_[1];
  rows_[1] = failed_row("i", "b");
  run({0, 1});
  rows_[1] = good;  // with other options too
  EXPECT_EQ(left(), (Positions{1, 2, 3}));
  EXPECT_EQ(file_content(file()), json_line(rows_[0]) + "\n");
}

TEST_F(BenchTables, RefuseRowsOfOtherRuns) {
  run({0, 1});
  const auto said_after = [&](const auto& change) {
    const std::vector<Row> before = rows_;
    change(rows_[1].run);
    const std::string said = refused();
    rows_ = before;
    return said;
  };
  const auto expect = [](const std::string& said, const std::string& text) {
    EXPECT_NE(said.find("another run of b on i (" + text), std::string::npos) << said;
  };
  expect(said_after([](auto& run) { run.options = "--omega 0"; }),
         "options '--omega 0.01' there, '--omega 0' here)");
  expect(said_after([](auto& run) { run.seed = 8; }), "seed '7' there, '8' here)");
  expect(said_after([](auto& run) { run.time_limit_s = 0.5; }),
         "time limit '60' there, '0.5' here)");
  expect(said_after([](auto& run) { run.memory_limit_gb.reset(); }),
         "memory limit '1.5 GB' there, 'by the machine' here)");
  expect(said_after([](auto& run) { run.digest = "x"; }), "the instance or its map has changed");
  EXPECT_EQ(left(), (Positions{2, 3}));
  EXPECT_EQ(file_content(file()), json_line(rows_[0]) + "\n" + json_line(rows_[1]) + "\n");
}

TEST_F(BenchTables, KeepRowsThatTheCommandDoesNotName) {
  run({0, 1, 2});
  rows_ = {solved_row("j", "c"), solved_row("i", "b"), solved_row("k", "c")};
  rows_[1].run.seed = 7;
  EXPECT_EQ(left(), (Positions{0, 2}));
  EXPECT_EQ(ResultTable(folder()).rows().size(), 3U);
}

TEST_F(BenchTables, RefuseLinesThatAreNoRows) {
  run({0});
  directory_.write("results/results.jsonl", file_content(file()) + "nonsense\n");
  EXPECT_TRUE(refused().starts_with("results.jsonl: line 2: expected a row")) << refused();
}

TEST_F(BenchTables, RefuseASecondRow) {
  ResultTable table(folder());
  table.begin(runs());
  table.append(rows_[0]);
  EXPECT_THROW(table.append(rows_[0]), std::logic_error);
}

TEST_F(BenchTables, BelongToOneBenchAtATime) {
  const ResultTable table(folder());
  EXPECT_NE(refused().find("is in use by another run"), std::string::npos);
}

TEST_F(BenchTables, AreCsvInTheOrderOfTheCommand) {
  run({3, 1});
  rows_.erase(rows_.begin() + 3);
  ResultTable table(folder());
  table.begin(runs());
  table.append(rows_[0]);
  table.write_csv();
  EXPECT_EQ(
      file_content(folder() + "/results.csv"),
      csv_header() + csv_line(rows_[0]) + csv_line(rows_[1]) + csv_line(solved_row("j", "b")));
}

}  // namespace result_table_test
}  // namespace grove::bench
