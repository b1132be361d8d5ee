// SPDX-License-Identifier: MIT
// For each kind of malformed file the program exits with code 2 and prints one line that names the
// file and the position. The tests of the readers compare the full messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace malformed_files_test {

using ::testing::StartsWith;

struct Malformed {
  std::string name;     // name of the test case
  std::string content;  // content of the file
  std::string place;    // start of the message after the file name
};

void PrintTo(const Malformed& malformed, std::ostream* out) {
  *out << malformed.name;
}

std::string name_of(const ::testing::TestParamInfo<Malformed>& info) {
  return info.param.name;
}

const std::string kMap = "type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n";
const std::string kScenario = "version 1\n0\tm.map\t3\t2\t0\t0\t2\t0\t2\n";
const std::string kInstance =
    R"({"map": "m.map", "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}], "tasks": []})";
const std::string kPlan =
    R"({"status": "optimal", "cost": 4, "lower_bound": 4, "omega": 0, "agents":
  [{"id": "a", "sequence": [], "cost": 4, "path": [[0,0],[0,1],[1,1],[2,1],[2,0]]}]})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

class MalformedFiles : public ::testing::TestWithParam<Malformed> {
 protected:
  MalformedFiles() {
    directory_.write("m.map", kMap);
    directory_.write("m.scen", kScenario);
    directory_.write("i.json", kInstance);
    directory_.write("p.json", kPlan);
  }

  std::string check_instance() const {
    return complaint(run_grove({"check", directory_ / "i.json", directory_ / "p.json"}));
  }
  std::string check_scenario(const std::string& agents) const {
    return complaint(run_grove({"check", directory_ / "m.scen", "--map", directory_ / "m.map",
                                "--agents", agents, directory_ / "p.json"}));
  }
  // Writes the content of the test case to the file `name`, calls `act` and expects the refusal.
  template <typename Act>
  void expect_refused(const std::string& name, Act act) const {
    directory_.write(name, GetParam().content);
    const std::string expected = (directory_ / name) + ": " + GetParam().place;
    const std::string said = act();
    EXPECT_TRUE(said.starts_with(expected)) << said << "\nexpected: " << expected;
  }

  TemporaryDirectory directory_;
};

TEST_F(MalformedFiles, UnchangedFilesAreAccepted) {
  EXPECT_EQ(run_grove({"check", directory_ / "i.json", directory_ / "p.json"}).err, "");
}

TEST_F(MalformedFiles, UnreadableFileIsRefused) {
  const auto expect_refused = [&](const std::string& wrong, const std::string& why) {
    EXPECT_THAT(complaint(run_grove({"check", wrong, directory_ / "p.json"})),
                StartsWith(wrong + why));
    EXPECT_THAT(complaint(run_grove({"check", directory_ / "i.json", wrong})),
                StartsWith(wrong + why));
  };
  for (const std::string& wrong :
       {directory_ / "none", std::string("/proc/self/mem"), std::string("")})
    expect_refused(wrong, ": cannot be read: ");
  expect_refused(directory_.path().string(), ": is a folder; expected a file");
}

TEST_F(MalformedFiles, MoreAgentsThanRowsAreRefused) {
  EXPECT_EQ(check_scenario("2"),
            (directory_ / "m.scen") + ": has 1 rows; expected at least 2, one per agent");
}

class MalformedInstance : public MalformedFiles {};
TEST_P(MalformedInstance, IsRefused) {
  expect_refused("i.json", [this] { return check_instance(); });
}

Malformed instance_with(const std::string& name, const std::string& from, const std::string& to,
                        const std::string& place) {
  return {name, replaced(kInstance, from, to), place};
}

INSTANTIATE_TEST_SUITE_P(
    Json, MalformedInstance,
    ::testing::Values(
        Malformed{"Empty", "", "is empty"},
        Malformed{"Truncated", "{\"map\": \"m.map\",\n\"agents\": [", "line 2, column 12: "},
        Malformed{"NotJson", "hello", "line 1, column 1: "}, Malformed{"Array", "[]", "/: "},
        Malformed{"Binary",
                  std::string("\x7f"
                              "ELF\0\1\xff",
                              7),
                  "line 1, column 1: "},
        Malformed{"TwoDocuments", kInstance + kInstance, "line 1, column "},
        Malformed{"DeepArrays", std::string(100'000, '['), "/0/0/0/"},
        Malformed{"DeepInside", "{\"map\": " + std::string(100'000, '['), "/map/0/0/"},
        Malformed{"RepeatedKey", "{\"map\": \"m.map\", \"map\": \"m.map\"}",
                  "/: key 'map' appears twice"},
        instance_with("BadUtf8", "\"a\"", "\"\xff\"", "line 1, column "),
        instance_with("HugeNumber", "[0, 0]", "[0, 1e400]", "line 1, column "),
        instance_with("Newline", "\"a\"", "\"a\nb\"", "line 1, column ")),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Values, MalformedInstance,
    ::testing::Values(
        instance_with("MissingKey", "\"start\"", "\"_start\"", "/agents/0: key 'start' is missing"),
        instance_with("WrongType", "\"a\"", "7", "/agents/0/id: "),
        instance_with("Fraction", "[0, 0]", "[0, 0.5]", "/agents/0/start/1: "),
        instance_with("Negative", "[0, 0]", "[0, -1]", "/agents/0/start/1: "),
        instance_with("BeyondInt", "[0, 0]", "[99999999999, 0]", "/agents/0/start/0: "),
        instance_with("BeyondInt64", "[0, 0]", "[99999999999999999999999, 0]",
                      "/agents/0/start/0: "),
        instance_with("Blocked", "[0, 0]", "[1, 0]", "/agents/0/start: "),
        instance_with("Outside", "[2, 0]", "[3, 0]", "/agents/0/goal: "),
        instance_with("EmptyId", "\"a\"", "\"\"", "/agents/0/id: "),
        instance_with("RepeatedId", "\"goal\": [2, 0]}",
                      "\"goal\": [2, 0]}, {\"id\": \"a\", \"start\": [0, 1]}", "/agents/1/id: "),
        instance_with("RepeatedStart", "\"goal\": [2, 0]}",
                      "\"goal\": [2, 0]}, {\"id\": \"b\", \"start\": [0, 0]}", "/agents/1/start: "),
        instance_with("UnknownAgent", "\"tasks\": []",
                      R"("tasks": [{"id": "t", "cell": [0, 0], "agents": ["a\n\u0007b"]}])",
                      "/tasks/0/agents/0: there is no agent 'a\\n\\x07b'"),
        instance_with("HeadingOfNoAgent", "\"goal\": [2, 0]", "\"heading\": \"N\"",
                      "/agents/0/heading: "),
        instance_with("NoAgents", R"({"id": "a", "start": [0, 0], "goal": [2, 0]})", "",
                      "/agents: ")),
    name_of);

class MalformedMap : public MalformedFiles {};
TEST_P(MalformedMap, IsRefused) {
  expect_refused("m.map", [this] { return check_instance(); });
}

INSTANTIATE_TEST_SUITE_P(
    Map, MalformedMap,
    ::testing::Values(
        Malformed{"Empty", "", "line 1, column 1: "},
        Malformed{"WrongType", replaced(kMap, "octile", "tile"), "line 1, column 1: "},
        Malformed{"NoHeight", replaced(kMap, "height 2\n", ""), "line 3, column 1: "},
        Malformed{"WrongHeight", replaced(kMap, "height 2", "height two"), "line 2, column 8: "},
        Malformed{"HugeSize", replaced(kMap, "height 2", "height 99999999999"),
                  "line 2, column 8: "},
        Malformed{"TooManyCells", replaced(kMap, "height 2", "height 67108864"),
                  "line 2, column 1: "},
        Malformed{"MissingRows", replaced(kMap, "...\n", ""), "line 6, column 1: "},
        Malformed{"TooManyRows", kMap + "...\n", "line 7, column 1: "},
        Malformed{"ShortRow", replaced(kMap, ".@.", ".@"), "line 5, column 3: "},
        Malformed{"LongRow", replaced(kMap, ".@.", ".@.."), "line 5, column 4: "},
        Malformed{"UnknownCharacter", replaced(kMap, "...", ".?."), "line 6, column 2: "},
        Malformed{"ControlCharacter", replaced(kMap, "...", ".\x1b."), "line 6, column 2: "}),
    name_of);

class MalformedScenario : public MalformedFiles {};
TEST_P(MalformedScenario, IsRefused) {
  expect_refused("m.scen", [this] { return check_scenario("1"); });
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, MalformedScenario,
    ::testing::Values(
        Malformed{"Empty", "", "line 1, column 1: "},
        Malformed{"WrongVersion", replaced(kScenario, "1", "3"), "line 1, column 1: "},
        Malformed{"MissingField", replaced(kScenario, "\t2\n", "\n"), "line 2, column 20: "},
        Malformed{"WrongNumber", replaced(kScenario, "\t0\t0\t2", "\t0\tx\t2"),
                  "line 2, column 15: "},
        Malformed{"OtherMap", replaced(kScenario, "m.map", "other.map"),
                  "line 2: the row is for map 'other.map'"},
        Malformed{"OtherSize", replaced(kScenario, "\t3\t2\t", "\t2\t2\t"),
                  "line 2: the row is for a map of 2 x 2"},
        Malformed{"BlockedGoal", replaced(kScenario, "\t2\t0\t2", "\t1\t0\t2"), "line 2, goal: "},
        Malformed{"NoRows", "version 1\n", "has 0 rows"}),
    name_of);

class MalformedPlan : public MalformedFiles {};
TEST_P(MalformedPlan, IsRefused) {
  expect_refused("p.json", [this] { return check_instance(); });
}

INSTANTIATE_TEST_SUITE_P(
    Plan, MalformedPlan,
    ::testing::Values(
        Malformed{"Empty", "", "is empty"},
        Malformed{"Truncated", kPlan.substr(0, kPlan.size() / 2), "line "},
        Malformed{"UnknownStatus", replaced(kPlan, "optimal", "best"), "/status: "},
        Malformed{"CellOutside", replaced(kPlan, "[2,1]", "[2,2]"), "/agents/0/path/3: "},
        Malformed{"FractionalCell", replaced(kPlan, "[2,1]", "[2,1.5]"), "/agents/0/path/3/1: "},
        Malformed{"UnknownAgent", replaced(kPlan, "\"a\"", "\"z\""), "/agents/0/id: "},
        Malformed{"UnknownTask", replaced(kPlan, "[]", "[\"t\"]"), "/agents/0/sequence/0: "},
        Malformed{"HugeCost", replaced(kPlan, "4", "1e30"), "/cost: "},
        Malformed{"WrongOmega", replaced(kPlan, "\"omega\": 0", "\"omega\": \"small\""),
                  "/omega: "}),
    name_of);

}  // namespace malformed_files_test
}  // namespace grove::detail
