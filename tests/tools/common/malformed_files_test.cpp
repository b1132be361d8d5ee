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

using ::testing::HasSubstr;
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

// Robot a chooses its goal; any robot may do t; a or b does u.
const std::string kChoices = R"({"map": "m.map", "agents": [
  {"id": "a", "start": [0, 0], "goals": [[0, 0], [0, 1]]}, {"id": "b", "start": [0, 1]},
  {"id": "c", "start": [2, 0]}], "tasks": [
  {"id": "t", "cell": [1, 1], "agents": "*", "need": 1, "duration": 2},
  {"id": "u", "cell": [2, 1], "agents": ["a", "b"], "need": 1, "duration": 1}]})";
const std::string kChoicesPlan =
    R"({"status": "optimal", "cost": 5, "lower_bound": 5, "omega": 0, "agents": [
  {"id": "a", "sequence": [], "cost": 0, "path": [[0, 0]]},
  {"id": "b", "sequence": ["t", "u"], "cost": 5, "work": [{"task": "t", "begin": 1, "end": 3}, {"task": "u", "begin": 4, "end": 5}],
   "path": [[0, 1], [1, 1], [1, 1], [1, 1], [2, 1]]},
  {"id": "c", "sequence": [], "cost": 0, "path": [[2, 0]]}]})";

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

class MalformedChoices : public MalformedFiles {};
TEST_P(MalformedChoices, AreRefusedWithAnExpectation) {
  expect_refused("i.json", [this] {
    const std::string said = check_instance();
    EXPECT_THAT(said, HasSubstr("; expected "));
    return said;
  });
}

TEST_F(MalformedFiles, UnchangedChoicesAreAccepted) {
  directory_.write("i.json", kChoices);
  directory_.write("p.json", kChoicesPlan);
  EXPECT_EQ(run_grove({"check", directory_ / "i.json", directory_ / "p.json"}).out,
            "valid: cost 5, lower bound 5, gap 0.00 %, 3 agents\n");
}

Malformed goals_with(const std::string& name, const std::string& goals, const std::string& place) {
  return {name, replaced(kChoices, "[[0, 0], [0, 1]]", goals), "/agents/0/goals" + place};
}

INSTANTIATE_TEST_SUITE_P(
    Goals, MalformedChoices,
    ::testing::Values(
        goals_with("Empty", "[]", ": found an empty list; "),
        goals_with("OneCell", "[0, 1]", ": found one cell; "),
        goals_with("Text", "\"*\"", ": found \"*\"; "),
        goals_with("Null", "null", ": found null; "),
        goals_with("Object", "{}", ": found an object; "),
        goals_with("Number", "[[0, 0], 1]", "/1: found 1; "),
        goals_with("Blocked", "[[0, 0], [1, 0]]", "/1: cell [1, 0] is blocked"),
        goals_with("Outside", "[[0, 0], [3, 0]]", "/1: cell [3, 0] is outside the map"),
        goals_with("Negative", "[[0, -1]]", "/0/1: found -1; "),
        goals_with("Fraction", "[[0, 0.5]]", "/0/1: found 0.5; "),
        goals_with("Heading", "[[0, 0, \"N\"]]", "/0: "),
        goals_with("Vertex", "[\"gate\"]", "/0: "),
        goals_with("Repeated", "[[0, 0], [0, 1], [0, 0]]", "/2: cell [0, 0] is listed twice; "),
        goals_with("AndGoal", R"([[0, 0]], "goal": [0, 1])", ": found both 'goal' and 'goals'; "),
        Malformed{"GoalIsAList", replaced(kChoices, "\"goals\"", "\"goal\""),
                  "/agents/0/goal: found a list of places; expected one place, or the key 'goals'"},
        Malformed{"OtherName", replaced(kChoices, "\"goals\"", "\"destinations\""),
                  "/agents/0: unknown key 'destinations'; expected 'goals'"},
        Malformed{"OfATask", replaced(kChoices, "\"duration\": 2", "\"goals\": [[0, 0]]"),
                  "/tasks/0: unknown key 'goals'; this key belongs to an agent; "},
        Malformed{"HeadingWithoutTurns",
                  replaced(kChoices, "\"goals\"", "\"goal_heading\": \"N\", \"goals\""),
                  "/agents/0/goal_heading: "}),
    name_of);

Malformed need_with(const std::string& name, const std::string& need, const std::string& found) {
  return {name, replaced(kChoices, "\"need\": 1", "\"need\": " + need),
          "/tasks/0/need: found " + found + "; expected an integer from 1 to 3, the number of "};
}

INSTANTIATE_TEST_SUITE_P(
    Need, MalformedChoices,
    ::testing::Values(
        need_with("Zero", "0", "0"), need_with("Negative", "-1", "-1"),
        need_with("MoreThanAgents", "4", "4"), need_with("Fraction", "1.5", "1.5"),
        need_with("RealNumber", "1.0", "1.0"), need_with("Text", "\"1\"", "\"1\""),
        need_with("Null", "null", "null"), need_with("Boolean", "true", "true"),
        need_with("List", "[1]", "an array"), need_with("BeyondInt", "3000000000", "3000000000"),
        Malformed{"MoreThanListedAgents",
                  replaced(kChoices, R"("b"], "need": 1)", R"("b"], "need": 3)"),
                  "/tasks/1/need: found 3; expected an integer from 1 to 2, the number of "},
        Malformed{"OtherName", replaced(kChoices, "\"need\"", "\"required\""),
                  "/tasks/0: unknown key 'required'; expected 'need'"},
        Malformed{"OfAnAgent", replaced(kChoices, "\"goals\"", "\"need\": 1, \"goals\""),
                  "/agents/0: unknown key 'need'; this key belongs to a task; "}),
    name_of);

Malformed agents_with(const std::string& name, const std::string& agents,
                      const std::string& place) {
  return {name, replaced(kChoices, "\"*\"", agents), "/tasks/0/agents" + place};
}

INSTANTIATE_TEST_SUITE_P(
    Agents, MalformedChoices,
    ::testing::Values(agents_with("Word", "\"all\"",
                                  ": found \"all\"; expected a list of ids, or \"*\""),
                      agents_with("EmptyText", "\"\"", ": found \"\"; "),
                      agents_with("Null", "null", ": "),
                      agents_with("StarInAList", "[\"*\"]",
                                  "/0: there is no agent '*'; expected \"agents\": \"*\""),
                      agents_with("StarBehindAnId", R"(["a", "*"])", "/1: there is no agent '*'; "),
                      agents_with("Unknown", "[\"z\"]", "/0: there is no agent 'z'; "),
                      agents_with("Repeated", R"(["a", "a"])", "/1: agent 'a' is listed twice; "),
                      agents_with("Number", "[0]", "/0: found 0; "),
                      Malformed{"Missing", replaced(kChoices, "\"agents\": \"*\", ", ""),
                                "/tasks/0: key 'agents' is missing; "}),
    name_of);

TEST_F(MalformedFiles, TaskWithoutAgentsIsRefused) {
  directory_.write("i.json", replaced(kChoices, "\"*\"", "[]"));
  EXPECT_EQ(check_instance(),
            (directory_ / "i.json") + ": /tasks/0/agents: expected at least one agent");
}

class MalformedWork : public MalformedFiles {};
TEST_P(MalformedWork, IsRefused) {
  directory_.write("i.json", kChoices);
  expect_refused("p.json", [this] {
    const std::string said = check_instance();
    EXPECT_THAT(said, HasSubstr("expected "));
    return said;
  });
}

Malformed work_with(const std::string& name, const std::string& from, const std::string& to,
                    const std::string& place) {
  return {name, replaced(kChoicesPlan, from, to), "/agents/1/" + place};
}

INSTANTIATE_TEST_SUITE_P(
    Work, MalformedWork,
    ::testing::Values(
        work_with("UnknownTask", "\"task\": \"t\"", "\"task\": \"z\"",
                  "work/0/task: there is no task 'z' in the instance; "),
        work_with("NumberOfATask", "\"task\": \"t\"", "\"task\": 0", "work/0/task: found 0; "),
        work_with("NoTask", "\"task\": \"t\", ", "", "work/0: key 'task' is missing; "),
        work_with("NoEnd", ", \"end\": 3", "", "work/0: key 'end' is missing; "),
        work_with("Fraction", "\"end\": 3", "\"end\": 2.5", "work/0/end: found 2.5; "),
        work_with("Text", "\"begin\": 1", "\"begin\": \"1\"", "work/0/begin: found \"1\"; "),
        work_with("OtherName", "\"begin\": 4", "\"start\": 4",
                  "work/1: unknown key 'start'; expected 'begin'"),
        work_with("NotAList",
                  "[{\"task\": \"t\", \"begin\": 1, \"end\": 3}, {\"task\": \"u\", \"begin\": 4, "
                  "\"end\": 5}]",
                  "\"t\"", "work: found \"t\"; "),
        work_with("NotAnObject", "{\"task\": \"t\", \"begin\": 1, \"end\": 3}", "\"t\"",
                  "work/0: found \"t\"; "),
        work_with("UnknownTaskInTheSequence", "[\"t\", \"u\"]", "[\"t\", \"z\"]",
                  "sequence/1: there is no task 'z' in the instance; ")),
    name_of);

// The file can be read, but the plan is not valid: `grove check` prints violations.
class InvalidVisits : public MalformedFiles {};
TEST_P(InvalidVisits, AreViolations) {
  directory_.write("i.json", kChoices);
  directory_.write("p.json", GetParam().content);
  const ProcessResult result = run_grove({"check", directory_ / "i.json", directory_ / "p.json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr((directory_ / "p.json") + ": " + GetParam().place));
}

Malformed visit_with(const std::string& name, const std::string& from, const std::string& to,
                     const std::string& place) {
  return {name, replaced(kChoicesPlan, from, to), place};
}

INSTANTIATE_TEST_SUITE_P(
    Work, InvalidVisits,
    ::testing::Values(
        visit_with("EndIsNotBeginPlusDuration", "\"end\": 3", "\"end\": 2",
                   "/agents/1/work/0: task 't' takes 2 steps, but this work goes from 1 to 2"),
        visit_with("EndBeforeBegin", "\"end\": 3", "\"end\": 0",
                   "/agents/1/work/0: task 't' takes 2 "),
        visit_with("Overlap", "\"begin\": 4, \"end\": 5", "\"begin\": 2, \"end\": 3",
                   "/agents/1/work/1: agent 'b' works on tasks 't' and 'u' at the same time"),
        visit_with("Elsewhere", "\"begin\": 1, \"end\": 3", "\"begin\": 0, \"end\": 2",
                   "/agents/1/work/0: agent 'b' is on [0, 1] when it begins task 't'; expected "),
        visit_with("Leaves", "\"begin\": 1, \"end\": 3", "\"begin\": 2, \"end\": 4",
                   "/agents/1/path/4: agent 'b' leaves [1, 1] at work on task 't'"),
        visit_with("BeforeTheStart", "\"begin\": 1, \"end\": 3", "\"begin\": -1, \"end\": 1",
                   "/agents/1/work/0: agent 'b' begins task 't' at -1; expected 0 or later"),
        visit_with("Twice", "{\"task\": \"u\"",
                   R"({"task": "t", "begin": 1, "end": 3}, {"task": "u")",
                   "/agents/1/work/1: agent 'b' does task 't' a second time; expected each once"),
        visit_with(
            "OtherAgent", R"("sequence": [], "cost": 0, "path": [[2, 0]])",
            R"("sequence": ["u"], "cost": 2, "work": [{"task": "u", "begin": 1, "end": 2}], "path": [[2, 0], [2, 1]])",
            "/agents/2/work/0: task 'u' does not list agent 'c'; expected a task that does"),
        visit_with("NotInTheSequence", "[\"t\", \"u\"]", "[\"u\"]",
                   "/agents/1/sequence: task 't' is missing; expected every task of agent 'b'"),
        visit_with("OtherOrder", "[\"t\", \"u\"]", "[\"u\", \"t\"]", "/agents/1/sequence/1: "),
        visit_with("TooFewVisits", R"(, {"task": "u", "begin": 4, "end": 5})", "",
                   "/agents: task 'u' is visited by 0 of its agents; expected at least 1"),
        visit_with("EndAfterTheClaimedCost", "\"begin\": 4, \"end\": 5", "\"begin\": 5, \"end\": 6",
                   "/agents/1/cost: agent 'b' finishes at time 6, but the plan claims 5"),
        visit_with("EndsOnNoGoal", R"("cost": 0, "path": [[0, 0]])",
                   R"("cost": 2, "path": [[0, 0], [0, 1], [1, 1]])",
                   "/agents/0/path/2: agent 'a' ends on [1, 1]; expected one of its goals")),
    name_of);

}  // namespace malformed_files_test
}  // namespace grove::detail
