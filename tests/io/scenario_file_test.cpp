// SPDX-License-Identifier: MIT
#include "io/scenario_file.h"

#include <gtest/gtest.h>

#include "io/instance_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace scenario_file_test {

const std::string kVersion = "version 1\n";
const std::string kRow = "0\tm.map\t3\t2\t0\t0\t2\t1\t3\n";

class ScenarioFile : public ::testing::Test {
 protected:
  std::vector<ScenarioRow> read(const std::string& content) {
    return read_scenario(directory_.write("m.scen", content));
  }
  std::string refused(const std::string& content) {
    return refusal([&] { read(content); });
  }
  LoadedInstance read_instance(const std::string& content, int agents) {
    directory_.write("m.map", "type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n");
    return read_scenario_instance(directory_.write("m.scen", content), directory_ / "m.map",
                                  agents);
  }
  std::string refused_instance(const std::string& content, int agents) {
    return refusal([&] { read_instance(content, agents); });
  }

  TemporaryDirectory directory_;
};

TEST_F(ScenarioFile, ReadsRowsInOrder) {
  const auto rows = read(kVersion + "9\tmaps/m.map\t3\t2\t0\t0\t2\t1\t3.41421356\n" + kRow);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].map, "maps/m.map");
  EXPECT_EQ(rows[0].goal, (Position{2, 1}));
  EXPECT_EQ(rows[0].line, 2);
  EXPECT_EQ(rows[1].line, 3);
}

TEST_F(ScenarioFile, AcceptsVariantsOfOtherTools) {
  EXPECT_EQ(read("version 1.0\r\n0 m.map 3 2  0 0  2 1  3\r\n\r\n").size(), 1U);
  EXPECT_EQ(read(kVersion).size(), 0U);
}

TEST_F(ScenarioFile, RefusesInvalidFilesWithThePlace) {
  EXPECT_EQ(refused(""), "m.scen: line 1, column 1: expected 'version 1' as the first line");
  EXPECT_EQ(refused("version 2\n"),
            "m.scen: line 1, column 1: expected 'version 1' as the first line");
  EXPECT_EQ(refused(kRow), "m.scen: line 1, column 1: expected 'version 1' as the first line");
  EXPECT_EQ(refused(kVersion + "0\tm.map\t3\t2\t0\t0\t2\t1\n"),
            "m.scen: line 2, column 20: the row has 8 fields; expected 9: bucket, map, width, "
            "height, start x, start y, goal x, goal y, length");
  EXPECT_EQ(refused(kVersion + "0\tm.map\t3\t2\t0\t0\t2\t1\t3\t9\n").substr(0, 25),
            "m.scen: line 2, column 23");
  EXPECT_EQ(refused(kVersion + "\n" + kRow).substr(0, 24), "m.scen: line 2, column 1");
  EXPECT_EQ(refused(kVersion + kRow + "0\tm.map\t3\t2\t0\t1.5\t2\t1\t3\n"),
            "m.scen: line 3, column 15: found '1.5'; expected an integer from 0 to 2147483647");
}

TEST_F(ScenarioFile, RefusesInvalidNumbers) {
  for (const char* wrong : {"-1", "x", "99999999999", "1e400", "0x1", "+1"})
    EXPECT_EQ(refused(kVersion + "0\tm.map\t3\t2\t" + wrong + "\t0\t2\t1\t3\n").substr(0, 26),
              "m.scen: line 2, column 13:")
        << wrong;
  for (const char* wrong : {"-1", "nan", "inf", "x", "1e999"})
    EXPECT_EQ(refused(kVersion + "0\tm.map\t3\t2\t0\t0\t2\t1\t" + wrong + "\n").substr(0, 26),
              "m.scen: line 2, column 21:")
        << wrong;
  EXPECT_EQ(refused(kVersion + "0\tm.map\t0\t2\t0\t0\t2\t1\t3\n").substr(0, 25),
            "m.scen: line 2, column 9:");
}

TEST_F(ScenarioFile, FindsItsMapBesideIt) {
  const std::string file =
      directory_.write("m.scen", kVersion + "0\tfar/m.map\t3\t2\t0\t0\t2\t1\t3\n");
  EXPECT_EQ(map_beside(file), "");
  directory_.write("m.map", "");
  EXPECT_EQ(map_beside(file), directory_ / "m.map");
  EXPECT_EQ(map_beside(directory_.write("none.scen", kVersion)), "");
}

TEST_F(ScenarioFile, RoundTrips) {
  const std::string text = kVersion + "1\tm.map\t3\t2\t0\t0\t2\t1\t5\n";
  write_scenario(directory_ / "out.scen", read(text), {5});
  EXPECT_EQ(file_content(directory_ / "out.scen"), text);
}

TEST_F(ScenarioFile, MakesInstancesOfTheFirstRows) {
  const LoadedInstance loaded = read_instance(
      kVersion + kRow + "0\tm.map\t3\t2\t2\t0\t0\t1\t3\n0\tother.map\t9\t9\t0\t0\t0\t0\t0\n", 2);
  EXPECT_EQ(loaded.instance.agent_count(), 2);
  EXPECT_EQ(loaded.instance.task_count(), 0);
  EXPECT_EQ(loaded.instance.agent(1).id, "a1");
  EXPECT_EQ(loaded.instance.agent(1).start, 2);
  EXPECT_EQ(loaded.instance.agent(1).goal, 3);
  EXPECT_EQ(loaded.map_path, directory_ / "m.map");
}

TEST_F(ScenarioFile, RefusesRowsThatDoNotFitTheMap) {
  const auto refused_row = [&](const std::string& row) {
    return refused_instance(kVersion + row, 1);
  };
  EXPECT_EQ(refused_row("0\tother.map\t3\t2\t0\t0\t2\t1\t3\n"),
            "m.scen: line 2: the row is for map 'other.map'; expected 'm.map'");
  EXPECT_EQ(refused_row("0\tm.map\t2\t3\t0\t0\t1\t1\t3\n"),
            "m.scen: line 2: the row is for a map of 2 x 3 cells; expected 3 x 2");
  EXPECT_EQ(refused_row("0\tm.map\t3\t2\t1\t0\t2\t1\t3\n"),
            "m.scen: line 2, start: cell [1, 0] is blocked on the map; expected a passable cell");
  EXPECT_EQ(refused_row("0\tm.map\t3\t2\t0\t0\t2\t2\t3\n").substr(0, 45),
            "m.scen: line 2, goal: cell [2, 2] is outside ");
}

TEST_F(ScenarioFile, RefusesMoreAgentsThanRows) {
  EXPECT_EQ(refused_instance(kVersion + kRow, 2),
            "m.scen: has 1 rows; expected at least 2, one per agent");
  EXPECT_EQ(refused_instance(kVersion + kRow, 0), "m.scen: expected at least one agent");
  EXPECT_EQ(refused_instance(kVersion + kRow + kRow, 2).substr(0, 21), "m.scen: line 3, start");
}

}  // namespace scenario_file_test
}  // namespace grove::detail
