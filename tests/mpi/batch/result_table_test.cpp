// SPDX-License-Identifier: MIT
#include "mpi/batch/result_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "grove/io/plan_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::batch {
namespace result_table_test {

namespace fs = std::filesystem;

using Ids = std::vector<std::string>;

class Tables : public ::testing::Test {
 protected:
  static Entry entry(const std::string& id) {
    return {.id = id, .path = id + ".cts.json", .digest = "digest of " + id};
  }
  static std::vector<Entry> entries(const Ids& ids) {
    std::vector<Entry> entries;
    for (const std::string& id : ids) entries.push_back(entry(id));
    return entries;
  }
  static Ids ids(const auto& items) {
    Ids ids;
    for (const auto& item : items) ids.push_back(item.id);
    return ids;
  }
  // With its plan file.
  Row row(const std::string& id) {
    Row row;
    row.id = id;
    row.digest = entry(id).digest;
    row.result = {
        .status = Status::kOptimal, .cost = 5, .lower_bound = 5, .plan_file = plan_file(entry(id))};
    std::ofstream(fs::path(folder_) / row.result.plan_file) << "{}";
    return row;
  }
  static Row failed_row(const std::string& id) {
    Row row;
    row.id = id;
    row.digest = entry(id).digest;
    row.error = "it broke";
    return row;
  }
  // A run over a, b, c, d that finishes some of them and is then killed.
  void run(const std::vector<std::string>& finished) {
    ResultTable table(folder_, settings_);
    table.begin(batch_);
    for (const std::string& id : finished) table.append(std::vector{row(id)});
  }
  Ids left() {
    ResultTable table(folder_, settings_);
    return ids(table.begin(batch_));
  }
  std::string refused(const Settings& settings) {
    return refusal([&] { ResultTable(folder_, settings); });
  }
  std::string lines() { return file_content(fs::path(folder_) / "results.jsonl"); }
  void append_text(const std::string& text) {
    std::ofstream(fs::path(folder_) / "results.jsonl", std::ios::app) << text;
  }

  TemporaryDirectory directory_;
  const std::string folder_ = directory_ / "out/deep";
  const std::vector<Entry> batch_ = entries({"a", "b", "c", "d"});
  const Settings settings_{{"omega", "0.01"}, {"seed", "7"}};
};

TEST_F(Tables, BeginEmpty) {
  EXPECT_EQ(left(), (Ids{"a", "b", "c", "d"}));
  EXPECT_EQ(lines(), "");
  EXPECT_EQ(left(), (Ids{"a", "b", "c", "d"}));
}

TEST_F(Tables, GoOnWhereTheyStopped) {
  run({"a", "c"});
  const std::string before = lines();
  EXPECT_EQ(std::ranges::count(before, '\n'), 2);
  EXPECT_EQ(left(), (Ids{"b", "d"}));
  EXPECT_EQ(lines(), before);
  run({"d", "b"});
  EXPECT_EQ(left(), Ids{});
  EXPECT_EQ(std::ranges::count(lines(), '\n'), 4);
  EXPECT_TRUE(lines().starts_with(before));
  const ResultTable table(folder_, settings_);
  EXPECT_EQ(ids(table.rows()), (Ids{"a", "c", "d", "b"}));
  ASSERT_NE(table.find("d"), nullptr);
  EXPECT_EQ(*table.find("d"), row("d"));
  EXPECT_EQ(table.find("e"), nullptr);
}

// Wherever the last write was cut off.
TEST_F(Tables, MendATornLine) {
  run({"a", "b"});
  const std::string whole = lines();
  const std::string line = whole.substr(whole.find('\n') + 1);
  for (std::size_t size = 1; size < line.size(); size += size + 29 < line.size() ? 29 : 1) {
    std::ofstream(fs::path(folder_) / "results.jsonl") << whole << line.substr(0, size);
    ASSERT_EQ(left(), (Ids{"c", "d"})) << size;
    ASSERT_EQ(lines(), whole) << size;
  }
  std::ofstream(fs::path(folder_) / "results.jsonl") << whole << line.substr(0, 20);
  run({"c"});
  EXPECT_EQ(left(), Ids{"d"});
  EXPECT_TRUE(lines().starts_with(whole));
}

TEST_F(Tables, SolveFailuresAgain) {
  {
    ResultTable table(folder_, settings_);
    table.begin(batch_);
    table.append(std::vector{failed_row("a"), row("b"), failed_row("c")});
    EXPECT_EQ(ids(table.rows()), (Ids{"a", "b", "c"}));
  }
  EXPECT_EQ(left(), (Ids{"a", "c", "d"}));
  run({"a", "c", "d"});
  EXPECT_EQ(left(), Ids{});
  EXPECT_EQ(std::ranges::count(lines(), '\n'), 4);
  EXPECT_EQ(lines().find("it broke"), std::string::npos);
}

TEST_F(Tables, SolveAgainWhatLostItsPlan) {
  run({"a", "b", "c", "d"});
  fs::remove(fs::path(folder_) / "plans/c.plan.json");
  EXPECT_EQ(left(), Ids{"c"});
  run({"c"});
  EXPECT_EQ(left(), Ids{});
}

TEST_F(Tables, SolveAgainWhatHasChanged) {
  run({"a", "b", "c", "d"});
  std::vector<Entry> changed = batch_;
  changed[1].digest = "another";
  ResultTable table(folder_, settings_);
  EXPECT_EQ(ids(table.begin(changed)), Ids{"b"});
  EXPECT_EQ(ids(table.rows()), (Ids{"a", "c", "d"}));
}

TEST_F(Tables, KeepRowsThatTheBatchDoesNotName) {
  run({"b", "d", "c"});
  {
    ResultTable table(folder_, settings_);
    EXPECT_EQ(ids(table.begin(entries({"e", "c"}))), Ids{"e"});
    table.append(std::vector{row("e")});
  }
  EXPECT_EQ(left(), Ids{"a"});
  const ResultTable table(folder_, settings_);
  EXPECT_EQ(ids(table.rows()), (Ids{"b", "d", "c", "e"}));
}

TEST_F(Tables, RefuseOtherSettings) {
  run({"a"});
  const std::string before = lines();
  EXPECT_EQ(refused({{"omega", "0"}, {"seed", "7"}}),
            "results.jsonl: line 1: was made with other options; expected the same, or another "
            "--output, or this one deleted (omega 0.01 there, 0 here)");
  EXPECT_NE(refused({{"omega", "inf"}, {"policy", "free"}})
                .find("(omega 0.01 there, inf here; policy not given there, free here; seed 7 "
                      "there, not given here)"),
            std::string::npos);
  EXPECT_EQ(refused(settings_), "accepted");
  EXPECT_EQ(lines(), before);
}

TEST_F(Tables, RefuseLinesThatAreNoRows) {
  run({"a", "b"});
  append_text("\nnonsense\n");
  EXPECT_TRUE(refused(settings_).starts_with(
      "results.jsonl: line 4: expected a row of results, or the line deleted to solve its instance "
      "again ("))
      << refused(settings_);
}

// As after putting two files together by hand.
TEST_F(Tables, KeepTheLastRowOfAnInstance) {
  run({"a", "b"});
  Row later = row("a");
  later.wall_s = 99;
  append_text("\n" + json_line(later, settings_) + "\n\n");
  EXPECT_EQ(left(), (Ids{"c", "d"}));
  EXPECT_EQ(std::ranges::count(lines(), '\n'), 2);
  const ResultTable table(folder_, settings_);
  EXPECT_EQ(table.find("a")->wall_s, 99);
  EXPECT_EQ(ids(table.rows()), (Ids{"b", "a"}));
}

TEST_F(Tables, RefuseASecondRow) {
  ResultTable table(folder_, settings_);
  table.begin(batch_);
  table.append(std::vector{row("a")});
  EXPECT_THROW(table.append(std::vector{row("a")}), std::logic_error);
  EXPECT_EQ(std::ranges::count(lines(), '\n'), 1);
}

TEST_F(Tables, BelongToOneRunAtATime) {
  const auto table = std::make_unique<ResultTable>(folder_, settings_);
  EXPECT_EQ(refused(settings_),
            "deep: is in use by another run; expected a folder that no other run writes to");
}

TEST_F(Tables, NeedAPlaceToWriteTo) {
  directory_.write("file", "");
  EXPECT_NE(refusal([&] { ResultTable(directory_ / "file", settings_); }).find("cannot be made"),
            std::string::npos);
  directory_.write("plans", "");
  EXPECT_NE(refusal([&] {
              ResultTable(directory_.path(), settings_).begin(batch_);
            }).find("plans: cannot be made"),
            std::string::npos);
}

TEST_F(Tables, AreCsvInTheOrderOfTheBatch) {
  run({"d"});
  {
    ResultTable table(folder_, settings_);
    const auto other = entries({"z", "c", "b", "x/y"});
    table.begin(other);
    table.append(std::vector{row("b"), row("x/y"), failed_row("z")});
    table.write_csv();
  }
  const std::string csv = file_content(fs::path(folder_) / "results.csv");
  std::vector<std::string> firsts;
  for (std::size_t at = 0; at < csv.size(); at = csv.find('\n', at) + 1)
    firsts.push_back(csv.substr(at, csv.find(',', at) - at));
  EXPECT_EQ(firsts, (Ids{"id", "z", "b", "x/y", "d"}));
  EXPECT_TRUE(csv.starts_with(csv_header(settings_)));
  EXPECT_NE(csv.find(csv_line(row("x/y"), settings_)), std::string::npos);
}

// What took the whole job down must not do so again before all others have had their turn.
TEST_F(Tables, PutLastWhatNeverEnded) {
  {
    ResultTable table(folder_, settings_);
    const auto todo = table.begin(batch_);
    for (const Entry& each : todo) table.note_begun(each);
    table.append(std::vector{row("b")});
  }
  std::ofstream(fs::path(folder_) / ".begun", std::ios::app) << "torn";
  {
    ResultTable table(folder_, settings_);
    const auto todo = table.begin(entries({"a", "b", "c", "d", "e"}));
    EXPECT_EQ(ids(todo), (Ids{"e", "a", "c", "d"}));
    table.note_begun(entry("e"));
    table.note_begun(entry("a"));
    table.append(std::vector{row("e")});
  }
  EXPECT_EQ(left(), (Ids{"c", "d", "a"}));
  {
    ResultTable table(folder_, settings_);
    table.begin(batch_);
    table.end();
  }
  EXPECT_EQ(left(), (Ids{"a", "c", "d"}));
}

TEST_F(Tables, HavePlansBesideThem) {
  ResultTable table(folder_, settings_);
  const Entry deep = entry("set/one/a");
  table.begin({deep});
  InstanceBuilder builder(Grid(2, 1, {true, true}));
  builder.add_agent("r", {0, 0}, Position{1, 0});
  const Instance instance = std::move(builder).build();
  Solution solution;
  EXPECT_EQ(write_plan(folder_, deep, instance, solution), "plans/set/one/a.plan.json");
  EXPECT_EQ(read_solution(folder_ + "/plans/set/one/a.plan.json", instance).status,
            Status::kUnknown);
}

}  // namespace result_table_test
}  // namespace grove::batch
