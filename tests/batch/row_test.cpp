// SPDX-License-Identifier: MIT
#include "batch/row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "tests/support/result_rows.h"

namespace grove::detail::batch {
namespace row_test {

using grove::detail::testing::failed_row;
using grove::detail::testing::solved_row;
using nlohmann::json;

Row limited_row() {
  Row row = solved_row();
  row.outcome.status = "feasible";
  row.outcome.solved = false;
  row.outcome.error = "time limit";
  row.plan_file = "plans/a, \"b\".plan.json";
  return row;
}

// A row for an instance that cannot be read.
Row unreadable_row() {
  Row row = failed_row();
  row.facts = {};
  row.run.digest.clear();
  return row;
}

TEST(Rows, RoundTripAsJsonLines) {
  for (const Row& row : {solved_row(), failed_row(), limited_row(), unreadable_row()}) {
    const std::string line = json_line(row);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_EQ(parse_json_line(line), row);
  }
}

TEST(Rows, HoldDerivedColumns) {
  const json solved = json::parse(json_line(solved_row()));
  EXPECT_EQ(solved["gap"], 0.25);
  EXPECT_EQ(solved["sqr"], 0.75);
  EXPECT_EQ(solved["runtime_s"], 1.25);
  EXPECT_TRUE(solved["error"].is_null());

  const json limited = json::parse(json_line(limited_row()));
  EXPECT_EQ(limited["runtime_s"], 60.0);
  EXPECT_EQ(limited["wall_s"], 1.25);
  EXPECT_TRUE(limited["sqr"].is_null());
  EXPECT_EQ(limited["gap"], 0.25);

  const json failed = json::parse(json_line(failed_row()));
  EXPECT_EQ(failed["runtime_s"], 60.0);
  for (const char* column :
       {"cost", "lower_bound", "gap", "sqr", "first_plan_s", "nodes", "scenario", "plan_file"})
    EXPECT_TRUE(failed[column].is_null()) << column;
  const json unreadable = json::parse(json_line(unreadable_row()));
  for (const char* column : {"map", "agents", "tasks", "problem"})
    EXPECT_TRUE(unreadable[column].is_null()) << column;
}

TEST(Rows, HaveNoRatioOverZero) {
  Row row = solved_row();
  row.outcome.cost = 3;
  row.outcome.lower_bound = 0;
  EXPECT_TRUE(json::parse(json_line(row))["gap"].is_null());
  row.outcome.cost = 0;
  EXPECT_EQ(json::parse(json_line(row))["gap"], 0.0);
  EXPECT_TRUE(json::parse(json_line(row))["sqr"].is_null());
}

TEST(Rows, AreWrittenAsCsvWithTheSameColumns) {
  EXPECT_EQ(csv_header(),
            "instance,method,options,map,scenario,agents,tasks,problem,omega,seed,time_limit_s,"
            "solved,status,cost,lower_bound,gap,root_cost,sqr,runtime_s,wall_s,first_plan_s,roots,"
            "rtsp_calls,nodes,low_level_calls,peak_memory_mb,version,machine,ended_at,error,ranks,"
            "threads,memory_limit_gb,plan_file,instance_digest,counts,solver,claimed_cost,"
            "claimed_lower_bound,claimed_s,anytime,trace,certified,verify_s,proof_bytes\n");
  EXPECT_EQ(csv_line(solved_row()),
            "set/a_s3_n2_m4_mg,auto,'--omega 0.01,\"a, \"\"b\"\"\",3,2,4,mg,0.01,7,60.0,true,"
            "bounded,200,160,0.25,150,0.75,1.25,1.25,0.25,3,4,5,6,7.25,grove 0.1.0 (git 0123),\"a "
            "processor, 2 cores\",2026-11-30T23:59:59Z,,4,2,1.5,,0123456789abcdef,bypasses=8 "
            "splits_vertex_edge=9,,,,,false,,,,\n");
  EXPECT_EQ(
      csv_line(failed_row()),
      "i,auto,'--omega 0.01,\"a, \"\"b\"\"\",,2,4,mg,0.01,7,60.0,false,error,,,,150,,60.0,1.25,"
      ",,,,,,grove,\"a processor, 2 cores\",2026-11-30T23:59:59Z,ended by signal 9 (Killed),4,2,"
      ",,0123456789abcdef,,,,,,false,,,,\n");
  Row row = failed_row();
  row.outcome.error = "two\nlines";
  EXPECT_NE(csv_line(row).find(",\"two\nlines\","), std::string::npos);
  EXPECT_NE(csv_line(limited_row()).find(",\"plans/a, \"\"b\"\".plan.json\","), std::string::npos);
}

TEST(Rows, HoldTheResultOfTheCertificate) {
  Row row = solved_row();
  row.outcome.certified = true;
  row.outcome.verify_s = 0.125;
  row.outcome.proof_bytes = 301;
  EXPECT_TRUE(csv_line(row).ends_with(",true,0.125,301\n"));
  EXPECT_EQ(parse_json_line(json_line(row)).outcome, row.outcome);
  row.outcome.certified = false;
  EXPECT_EQ(parse_json_line(json_line(row)).outcome.certified, false);
}

// Claims of other solvers survive a round trip in both formats.
TEST(Rows, HoldClaimsOfOtherSolvers) {
  Row row = solved_row();
  row.solver = "lacam3";
  row.outcome.claimed_cost = 198;
  row.outcome.claimed_lower_bound = 150;
  row.outcome.claimed_s = 0.75;
  row.outcome.anytime = true;
  row.outcome.trace = {{0.25, 210, std::nullopt}, {1, 200, 160}};
  EXPECT_EQ(parse_json_line(json_line(row)), row);
  EXPECT_TRUE(csv_line(row).ends_with(",lacam3,198,150,0.75,true,0.25:210:- 1:200:160,,,\n"));
  EXPECT_EQ(row.runtime_s(), 0.25);  // time of the first plan
  row.outcome.first_plan_s.reset();
  EXPECT_EQ(row.runtime_s(), row.wall_s);
  row.wall_s = 61;
  EXPECT_EQ(row.runtime_s(), 60);
  for (const char* status : {kInvalidPlan, kClaimed, kUnsupported}) {
    Row none = failed_row();
    none.outcome.status = status;
    EXPECT_EQ(parse_json_line(json_line(none)), none);
    EXPECT_EQ(none.runtime_s(), 60);
  }
}

constexpr std::array<std::string_view, 10> kLater{
    "counts", "solver",    "claimed_cost", "claimed_lower_bound", "claimed_s", "anytime",
    "trace",  "certified", "verify_s",     "proof_bytes"};

// Tables from older versions, which lack some columns, can be resumed.
TEST(Rows, AreReadWithoutLaterColumns) {
  json line = json::parse(json_line(solved_row()));
  for (const std::string_view column : kLater) line.erase(std::string(column));
  Row expected = solved_row();
  expected.outcome.counts = "";
  EXPECT_EQ(parse_json_line(line.dump()), expected);
}

TEST(Rows, AcceptOldStatuses) {
  Row row = failed_row();
  for (const auto& [old, now] : {std::pair{"wrong", kInvalidPlan}, {"unsuitable", kUnsupported}}) {
    json line = json::parse(json_line(row));
    line["status"] = old;
    EXPECT_EQ(parse_json_line(line.dump()).outcome.status, now);
  }
}

TEST(Rows, RoundSecondsToReadableNumbers) {
  Row row = solved_row();
  row.wall_s = 0.00015441900177393109;
  row.outcome.first_plan_s = 1.0 / 3;
  const json found = json::parse(json_line(row));
  EXPECT_EQ(found["wall_s"].dump(), "0.000154");
  EXPECT_EQ(found["runtime_s"].dump(), "0.000154");
  EXPECT_EQ(found["first_plan_s"].dump(), "0.333333");
}

TEST(Rows, AreValidJsonDespiteInvalidUtf8) {
  Row row = failed_row();
  row.outcome.error = "\xff!";
  EXPECT_EQ(parse_json_line(json_line(row)).outcome.error, "\xef\xbf\xbd!");
}

TEST(Rows, RefuseInvalidLines) {
  const json good = json::parse(json_line(solved_row()));
  std::vector<std::string> bad{"", "{", "[]", "3", "null", "{}"};
  for (const auto& [key, value] : good.items()) {
    if (key == "gap" || key == "sqr" || key == "runtime_s") continue;  // derived, not read
    json without = good;
    without.erase(key);
    if (std::ranges::find(kLater, key) == kLater.end()) bad.push_back(without.dump());
    json wrong = good;
    wrong[key] = json::array({1});
    bad.push_back(wrong.dump());
  }
  json odd = good;
  odd["status"] = "fine";
  bad.push_back(odd.dump());
  odd["status"] = "error";  // without an error text
  bad.push_back(odd.dump());
  odd["error"] = "broken";  // with an error text, but still with results
  bad.push_back(odd.dump());
  for (const std::string& line : bad)
    EXPECT_THROW(parse_json_line(line), std::invalid_argument) << line;
}

}  // namespace row_test
}  // namespace grove::detail::batch
