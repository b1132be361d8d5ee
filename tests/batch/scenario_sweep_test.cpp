// SPDX-License-Identifier: MIT
#include "batch/scenario_sweep.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail::batch {
namespace scenario_sweep_test {

namespace fs = std::filesystem;
using Ids = std::vector<std::string>;

class Sweeps : public ::testing::Test {
 protected:
  void add_map(const std::string& name, const std::string& row = "....") {
    add(name, "type octile\nheight 4\nwidth 4\nmap\n" + row + "\n....\n....\n....\n");
  }
  // Adds a scenario whose agents move from left to right, one in each row.
  void add_scenario(const std::string& name, int rows, const std::string& map = "m.map") {
    std::string text = "version 1\n";
    for (int y = 0; y < rows; ++y)
      text +=
          "0\t" + map + "\t4\t4\t0\t" + std::to_string(y) + "\t3\t" + std::to_string(y) + "\t3\n";
    add(name, text);
  }
  void add(const std::string& name, const std::string& content) {
    fs::create_directories(fs::path(directory_ / name).parent_path());
    directory_.write(name, content);
  }
  SweptScenarios read(std::vector<int> agents, const std::string& scenarios = "*",
                      const std::string& place = ".") {
    return read_scenarios(directory_ / place, {std::move(agents), scenarios});
  }
  static Ids ids(const SweptScenarios& swept) {
    Ids ids;
    for (const Entry& entry : swept.entries) ids.push_back(entry.id);
    return ids;
  }
  std::string refused(std::vector<int> agents, const std::string& scenarios = "*",
                      const std::string& place = ".") {
    return refusal([&] { read(std::move(agents), scenarios, place); });
  }

  TemporaryDirectory directory_;
};

TEST_F(Sweeps, TakeEachScenarioWithEachNumberOfAgents) {
  add_map("m.map");
  add_scenario("m-random-10.scen", 4);
  add_scenario("m-random-2.scen", 4);
  add_scenario("m-even-2.scen", 4);
  const auto swept = read({1, 3}, "m-random-*");
  EXPECT_EQ(ids(swept), (Ids{"m-random-2-1", "m-random-2-3", "m-random-10-1", "m-random-10-3"}));
  EXPECT_EQ(swept.too_short, 0);
  EXPECT_EQ(swept.entries[1].agents, 3);
  EXPECT_EQ(load(swept.entries[1]).instance.agent_count(), 3);
  EXPECT_FALSE(swept.entries[1].digest.empty());
  EXPECT_NE(swept.entries[0].digest, swept.entries[1].digest);
}

// The layout of the unpacked archives: maps in one folder and scenarios in another, whose rows name
// the maps with a path.
TEST_F(Sweeps, FindMapsInFoldersBelow) {
  add_map("maps/m.map");
  add_scenario("scen-random/m-random-1.scen", 2, "maps/m.map");
  EXPECT_EQ(ids(read({2})), Ids{"scen-random/m-random-1-2"});
}

TEST_F(Sweeps, PreferTheMapBesideTheScenario) {
  add_map("a/m.map", "...@");
  add_map("b/m.map");
  add_scenario("b/s.scen", 1);
  EXPECT_EQ(fs::path(read({1}).entries[0].map).parent_path().filename(), "b");
  add_scenario("c/s.scen", 1);
  EXPECT_EQ(refused({1}),
            "s.scen: line 2: there are 2 maps m.map there; expected one beside the scenario, or "
            "exactly one in the folder of the scenarios or below");
}

TEST_F(Sweeps, TakeOneScenario) {
  add_map("m.map");
  add_scenario("one.scen", 3);
  add_scenario("two.scen", 3);
  EXPECT_EQ(ids(read({1, 2}, "*", "one.scen")), (Ids{"one-1", "one-2"}));
}

TEST_F(Sweeps, SkipScenariosWithTooFewRows) {
  add_map("m.map");
  add_scenario("long.scen", 4);
  add_scenario("short.scen", 2);
  const auto swept = read({2, 3, 4});
  EXPECT_EQ(ids(swept), (Ids{"long-2", "long-3", "long-4", "short-2"}));
  EXPECT_EQ(swept.too_short, 1);
  EXPECT_NE(refused({5}).find("no scenario has 5 rows; expected fewer agents"), std::string::npos);
}

TEST_F(Sweeps, RefuseMissingScenariosAndMaps) {
  add_map("m.map");
  EXPECT_NE(refused({1}).find("has no scenario '*.scen'; expected at least one"),
            std::string::npos);
  add_scenario("s.scen", 1, "other.map");
  EXPECT_EQ(refused({1}),
            "s.scen: line 2: there is no map other.map there; expected one beside the scenario, or "
            "exactly one in the folder of the scenarios or below");
  EXPECT_NE(refused({1}, "t*").find("has no scenario 't*.scen'"), std::string::npos);
  add_scenario("empty.scen", 0);
  EXPECT_EQ(refused({1}, "empty"), "empty.scen: has no rows; expected at least one");
  EXPECT_NE(refused({1}, "*", "nowhere"), "accepted");
}

TEST_F(Sweeps, AreDetectedInFoldersAndFiles) {
  add_map("m.map");
  EXPECT_FALSE(holds_scenarios(directory_ / "."));
  add_scenario("s.scen", 1);
  EXPECT_TRUE(holds_scenarios(directory_ / "."));
  EXPECT_TRUE(holds_scenarios(directory_ / "s.scen"));
  add("i.cts.json", "{}");
  EXPECT_FALSE(holds_scenarios(directory_ / "."));
  EXPECT_FALSE(holds_scenarios(directory_ / "list.txt"));
}

TEST(ScenarioNames, MatchPatternsWithStars) {
  for (const char* pattern : {"*", "a-1", "a*", "*1", "a*1", "*-*", "a-1*", "**", "*a*-*1*"})
    EXPECT_TRUE(matches("a-1", pattern)) << pattern;
  for (const char* pattern : {"", "a", "-1", "b*", "*2", "a-11", "a*1*1"})
    EXPECT_FALSE(matches("a-1", pattern)) << pattern;
}

}  // namespace scenario_sweep_test
}  // namespace grove::detail::batch
