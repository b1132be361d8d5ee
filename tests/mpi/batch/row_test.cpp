// SPDX-License-Identifier: MIT
#include "mpi/batch/row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace grove::batch {
namespace row_test {

const Settings kSettings{{"omega", "0.01"}, {"seed", "7"}};

Row finished_row() {
  Row row;
  row.id = "set/a, \"b\"";
  row.instance = "in/set/a, \"b\".cts.json";
  row.digest = "0123456789abcdef";
  row.result = {.status = Status::kBounded,
                .cost = 637,
                .lower_bound = 631,
                .nodes_expanded = 12,
                .first_plan_s = 0.25,
                .stopped_by = "",
                .plan_file = "plans/set/a, \"b\".plan.json"};
  row.version = "grove 0.1.0 (git 0123)";
  row.ranks = 4;
  row.threads = 2;
  row.wall_s = 1.5;
  row.started_at = "2026-11-30T23:59:59Z";
  return row;
}

Row failed_row() {
  Row row = finished_row();
  row.result = {};
  row.error = "it broke";
  return row;
}

TEST(Rows, ComeBackFromTheirLines) {
  Row unknown = finished_row();
  unknown.result = {.status = Status::kUnknown,
                    .lower_bound = 3,
                    .nodes_expanded = 0,
                    .stopped_by = "time limit",
                    .plan_file = "p"};
  for (const Row& row : {finished_row(), failed_row(), unknown}) {
    const std::string line = json_line(row, kSettings);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const RowAndSettings read = parse_json_line(line);
    EXPECT_EQ(read.row, row);
    EXPECT_EQ(read.settings, kSettings);
  }
}

TEST(Rows, SayInJsonWhatOneLooksFor) {
  const auto json = nlohmann::json::parse(json_line(finished_row(), kSettings));
  EXPECT_EQ(json["status"], "bounded");
  EXPECT_EQ(json["cost"], 637);
  EXPECT_EQ(json["lower_bound"], 631);
  EXPECT_DOUBLE_EQ(json["gap"], 6.0 / 631);
  EXPECT_EQ(json["options"]["omega"], "0.01");
  const auto failed = nlohmann::json::parse(json_line(failed_row(), kSettings));
  EXPECT_EQ(failed["status"], "error");
  EXPECT_EQ(failed["error"], "it broke");
  for (const char* key : {"cost", "lower_bound", "gap", "first_plan_s"})
    EXPECT_TRUE(failed[key].is_null()) << key;
}

TEST(Rows, AreCsv) {
  EXPECT_EQ(csv_header(kSettings),
            "id,instance,status,cost,lower_bound,gap,omega,seed,version,ranks,threads,wall_s,"
            "nodes_expanded,first_plan_s,stopped_by,error,plan_file,started_at,instance_digest\n");
  Row row = finished_row();
  row.result.lower_bound = 637;
  EXPECT_EQ(csv_line(row, kSettings),
            "\"set/a, \"\"b\"\"\",\"in/set/a, \"\"b\"\".cts.json\",bounded,637,637,0.0,0.01,7,"
            "grove 0.1.0 (git 0123),4,2,1.5,12,0.25,,,\"plans/set/a, \"\"b\"\".plan.json\","
            "2026-11-30T23:59:59Z,0123456789abcdef\n");
  row = failed_row();
  row.error = "two\nlines";
  EXPECT_NE(csv_line(row, {}).find(",error,,,,grove"), std::string::npos);
  EXPECT_NE(csv_line(row, {}).find(",\"two\nlines\","), std::string::npos);
}

TEST(Rows, HaveAGapWhereThereIsOne) {
  EXPECT_EQ(gap({.cost = 110, .lower_bound = 100}), 0.1);
  EXPECT_EQ(gap({.cost = 0, .lower_bound = 0}), 0);
  EXPECT_EQ(gap({.cost = 3, .lower_bound = 0}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(gap({.lower_bound = 100}), std::nullopt);
  EXPECT_EQ(gap({.cost = 100}), std::nullopt);
  Row row = finished_row();
  row.result.lower_bound = 0;
  EXPECT_TRUE(nlohmann::json::parse(json_line(row, {}))["gap"].is_null());
  EXPECT_NE(csv_line(row, {}).find(",637,0,inf,"), std::string::npos);
}

TEST(Rows, HaveSecondsThatPeopleCanRead) {
  Row row = finished_row();
  row.wall_s = 0.00015441900177393109;
  row.result.first_plan_s = 1.0 / 3;
  const auto json = nlohmann::json::parse(json_line(row, {}));
  EXPECT_EQ(json["wall_s"].dump(), "0.000154");
  EXPECT_EQ(json["first_plan_s"].dump(), "0.333333");
}

TEST(Rows, WithTextThatIsNoUtf8AreStillJson) {
  Row row = failed_row();
  row.error = "\xff!";
  EXPECT_EQ(parse_json_line(json_line(row, {})).row.error, "\xef\xbf\xbd!");
}

TEST(Rows, RefuseWhatIsNone) {
  const auto good = nlohmann::json::parse(json_line(finished_row(), kSettings));
  std::vector<std::string> bad{"", "{", "[]", "3", "null", "{}"};
  for (const auto& [key, value] : good.items()) {
    if (key == "gap") continue;  // follows from the others, and is not read
    auto without = good;
    without.erase(key);
    bad.push_back(without.dump());
    auto wrong = good;
    wrong[key] = nlohmann::json::array({1});
    bad.push_back(wrong.dump());
  }
  auto odd = good;
  odd["status"] = "fine";
  bad.push_back(odd.dump());
  odd["status"] = "error";  // without one
  bad.push_back(odd.dump());
  odd["status"] = "optimal";
  odd["error"] = "but broken";
  bad.push_back(odd.dump());
  for (const std::string& line : bad)
    EXPECT_THROW(parse_json_line(line), std::invalid_argument) << line;
}

TEST(Results, SayWhatTheSolutionSays) {
  Solution solution;
  solution.status = Status::kFeasible;
  solution.plan.emplace().cost = 20;
  solution.lower_bound = 10;
  solution.stats.counts["nodes_expanded"] = 5;
  solution.stats.texts["stopped_by"] = "time limit";
  EXPECT_EQ(result_of(solution, "p"), (Result{.status = Status::kFeasible,
                                              .cost = 20,
                                              .lower_bound = 10,
                                              .nodes_expanded = 5,
                                              .stopped_by = "time limit",
                                              .plan_file = "p"}));
  EXPECT_FALSE(result_of(solution, "p").interrupted());
  solution.stats.texts["stopped_by"] = "interrupt";
  EXPECT_TRUE(result_of(solution, "p").interrupted());
  Solution infeasible;
  infeasible.status = Status::kInfeasible;
  EXPECT_EQ(result_of(infeasible, ""), (Result{.status = Status::kInfeasible}));
}

}  // namespace row_test
}  // namespace grove::batch
