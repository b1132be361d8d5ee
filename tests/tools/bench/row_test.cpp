// SPDX-License-Identifier: MIT
#include "tools/bench/row.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "rows.h"

namespace grove::bench {
namespace row_test {

Row limited_row() {
  Row row = solved_row();
  row.outcome.status = "feasible";
  row.outcome.solved = false;
  row.outcome.error = "time limit";
  return row;
}

TEST(BenchRows, ComeBackFromTheirLines) {
  for (const Row& row : {solved_row(), failed_row(), limited_row()}) {
    const std::string line = json_line(row);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_EQ(parse_json_line(line), row);
  }
}

TEST(BenchRows, SayWhatFollowsFromTheRest) {
  const auto solved = nlohmann::json::parse(json_line(solved_row()));
  EXPECT_EQ(solved["gap"], 0.25);
  EXPECT_EQ(solved["sqr"], 0.75);
  EXPECT_EQ(solved["runtime_s"], 1.25);
  EXPECT_TRUE(solved["error"].is_null());

  const auto limited = nlohmann::json::parse(json_line(limited_row()));
  EXPECT_EQ(limited["runtime_s"], 60.0);
  EXPECT_EQ(limited["wall_s"], 1.25);
  EXPECT_TRUE(limited["sqr"].is_null());
  EXPECT_EQ(limited["gap"], 0.25);

  const auto failed = nlohmann::json::parse(json_line(failed_row()));
  EXPECT_EQ(failed["runtime_s"], 60.0);
  for (const char* column : {"cost", "lower_bound", "gap", "sqr", "nodes", "scenario"})
    EXPECT_TRUE(failed[column].is_null()) << column;
}

TEST(BenchRows, HaveNoRatioOverNothing) {
  Row row = solved_row();
  row.outcome.cost = 3;
  row.outcome.lower_bound = 0;
  EXPECT_TRUE(nlohmann::json::parse(json_line(row))["gap"].is_null());
  row.outcome.cost = 0;
  EXPECT_EQ(nlohmann::json::parse(json_line(row))["gap"], 0.0);
  EXPECT_TRUE(nlohmann::json::parse(json_line(row))["sqr"].is_null());
}

TEST(BenchRows, AreCsvWithTheSameColumns) {
  EXPECT_EQ(csv_header(),
            "instance,method,options,map,scenario,agents,tasks,problem,omega,seed,time_limit_s,"
            "solved,status,cost,lower_bound,gap,root_cost,sqr,runtime_s,wall_s,roots,rtsp_calls,"
            "nodes,low_level_calls,peak_memory_mb,version,machine,ended_at,error,threads,"
            "memory_limit_gb,instance_digest\n");
  EXPECT_EQ(csv_line(solved_row()),
            "set/a_s3_n2_m4_mg,auto,--omega 0.01,\"a, \"\"b\"\"\",3,2,4,mg,0.01,7,60.0,true,"
            "bounded,200,160,0.25,150,0.75,1.25,1.25,3,4,5,6,7.25,grove 0.1.0 (git 0123),\"a "
            "processor, 2 cores\",2026-11-30T23:59:59Z,,2,1.5,0123456789abcdef\n");
  EXPECT_EQ(
      csv_line(failed_row()),
      "i,auto,--omega 0.01,\"a, \"\"b\"\"\",,2,4,mg,0.01,7,60.0,false,error,,,,150,,60.0,1.25,"
      ",,,,,grove,\"a processor, 2 cores\",2026-11-30T23:59:59Z,ended by signal 9 (Killed),2,"
      ",0123456789abcdef\n");
}

TEST(BenchRows, RefuseWhatIsNone) {
  EXPECT_THROW(parse_json_line("{"), std::invalid_argument);
  EXPECT_THROW(parse_json_line("{}"), std::invalid_argument);
  auto json = nlohmann::json::parse(json_line(solved_row()));
  json["status"] = "fine";
  EXPECT_THROW(parse_json_line(json.dump()), std::invalid_argument);
  json["status"] = 3;
  EXPECT_THROW(parse_json_line(json.dump()), std::invalid_argument);
}

}  // namespace row_test
}  // namespace grove::bench
