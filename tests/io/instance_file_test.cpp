// SPDX-License-Identifier: MIT
#include "io/instance_file.h"

#include <gtest/gtest.h>

#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace instance_file_test {

const std::string kAgents =
    R"("agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}, {"id": "m", "start": [0, 1]}])";
const std::string kTasks = R"("tasks": [{"id": "t", "cell": [2, 1], "agents": ["a", "m"]}])";
const std::string kMap = R"("map": "m.map")";

class InstanceFile : public ::testing::Test {
 protected:
  InstanceFile() { directory_.write("m.map", "type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n"); }

  LoadedInstance read(const std::string& content) {
    return read_instance(directory_.write("i.json", content));
  }
  std::string refused(const std::string& content) {
    return refusal([&] { read(content); });
  }
  std::string refused_agents(const std::string& agents) {
    return refused("{" + kMap + ", \"agents\": " + agents + ", " + kTasks + "}");
  }
  std::string refused_agent(const std::string& agent) { return refused_agents("[" + agent + "]"); }
  std::string refused_tasks(const std::string& tasks) {
    return refused("{" + kMap + ", " + kAgents + ", \"tasks\": " + tasks + "}");
  }

  TemporaryDirectory directory_;
};

TEST_F(InstanceFile, IsRead) {
  const LoadedInstance loaded = read("{" + kMap + ", " + kAgents + ", " + kTasks + "}");
  EXPECT_EQ(loaded.instance.agent_count(), 2);
  EXPECT_EQ(loaded.instance.agent(0).goal, 2);
  EXPECT_FALSE(loaded.instance.agent(1).goal);
  EXPECT_EQ(loaded.instance.task(0).agents, (std::vector<AgentIndex>{0, 1}));
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(loaded.map_path, directory_ / "m.map");
}

TEST_F(InstanceFile, IsReadFromATextInMemory) {
  const std::string text = "{" + kMap + ", " + kAgents + ", " + kTasks + "}";
  EXPECT_EQ(parse_instance(text, "x", directory_.path()).map_path, directory_ / "m.map");
  EXPECT_EQ(refusal([&] { parse_instance("{}", "standard input", ""); }),
            "standard input: /: key 'map' is missing; expected it, or 'roadmap', in this object");
}

TEST_F(InstanceFile, RoundTrips) {
  const std::string text =
      "{\n \"map\": \"m.map\",\n \"agents\": [\n"
      "  {\"id\":\"a\",\"start\":[0,0],\"goal\":[2,0]},\n"
      "  {\"id\":\"m\",\"start\":[0,1]}],\n \"tasks\": [\n"
      "  {\"id\":\"t\",\"cell\":[2,1],\"agents\":[\"a\",\"m\"]}]}\n";
  write_instance(directory_ / "out.json", read(text).instance, "m.map");
  EXPECT_EQ(file_content(directory_ / "out.json"), text);
}

TEST_F(InstanceFile, AcceptsCrlfAndAByteOrderMark) {
  EXPECT_EQ(read("\xEF\xBB\xBF{" + kMap + ",\r\n" + kAgents + ",\r\n" + kTasks + "}\r\n")
                .instance.task_count(),
            1);
}

TEST_F(InstanceFile, IgnoresRemarks) {
  const std::string rest = kMap + "," + kAgents + "," + kTasks + "}";
  EXPECT_TRUE(read(R"({"$schema": "instance.schema.json", )" + rest).warnings.empty());
  EXPECT_TRUE(read(R"({"_author": "me", )" + rest).warnings.empty());
}

TEST_F(InstanceFile, NamesLineAndColumnOfMalformedJson) {
  EXPECT_EQ(refused(""), "i.json: is empty; expected a JSON object");
  EXPECT_EQ(refused(" \n"), "i.json: is empty; expected a JSON object");
  EXPECT_EQ(refused("{\"map\": \"m.map\",\n \"agents\": [").substr(0, 40),
            "i.json: line 2, column 13: malformed JSO");
  EXPECT_EQ(refused("{\n  'map': 1}"),
            "i.json: line 2, column 3: malformed JSON: a single quote; expected text in double "
            "quotes");
  EXPECT_EQ(refused("{} {}").substr(0, 42), "i.json: line 1, column 4: malformed JSON: ");
  EXPECT_EQ(refused("{\"map\": \"\xff\"}").substr(0, 42),
            "i.json: line 1, column 10: malformed JSON:");
  EXPECT_EQ(refused("{\"map\": 1e400}"),
            "i.json: line 1, column 13: malformed JSON: a number is too large; expected one of "
            "double precision");
}

TEST_F(InstanceFile, ExplainsCommonMistakesInJson) {
  const std::string comment =
      ": malformed JSON: found a comment, which JSON does not allow; expected a key that begins "
      "with '_' instead";
  EXPECT_EQ(refused("{} // note"), "i.json: line 1, column 4" + comment);
  EXPECT_EQ(refused("{\"map\": 1// note\n}"), "i.json: line 1, column 10" + comment);
  EXPECT_EQ(refused("{\n  // note\n \"map\": 1}"), "i.json: line 2, column 3" + comment);
  EXPECT_EQ(refused("{/* note */}"), "i.json: line 1, column 2" + comment);
  EXPECT_EQ(refused("# note\n{}"), "i.json: line 1, column 1" + comment);
  for (const char* number : {"NaN", "nan", "Infinity", "-Infinity", "inf"})
    EXPECT_EQ(refused(std::string("{\"map\": [") + number + "]}"),
              "i.json: line 1, column 10: malformed JSON: found no valid JSON number; expected a "
              "finite number")
        << number;
  EXPECT_EQ(refused("{\"map\": True}"),
            "i.json: line 1, column 9: malformed JSON: found True; expected true, in lower case");
  for (const char* text : {"{\"map\": 1,}", "{\"map\": 1, }", "{\"map\": [1,\n]}"})
    EXPECT_TRUE(
        refused(text).ends_with("malformed JSON: a comma after the last value; expected none"))
        << refused(text);
}

TEST_F(InstanceFile, PlacesAreCellsAndNotMetres) {
  EXPECT_EQ(refused_agent(R"({"id": "a", "start": [1.5, 0]})"),
            "i.json: /agents/0/start/0: found 1.5; expected the column or row of a cell, a whole "
            "number; places on maps are cells, not metres");
  EXPECT_NE(refused_tasks(R"([{"id": "t", "cell": [2, 1.0], "agents": ["a"]}])").find("not metres"),
            std::string::npos);
}

TEST_F(InstanceFile, MapAndRoadmapAreNotInterchangeable) {
  directory_.write("r.roadmap.json", R"({"vertices": [{"id": "A", "at": [0, 0]}], "edges": []})");
  EXPECT_EQ(refused(R"({"map": "r.roadmap.json", "agents": [], "tasks": []})"),
            "i.json: /map: '" + (directory_ / "r.roadmap.json") +
                "' is a JSON file; expected a map, or this file under the key \"roadmap\" if it is "
                "a roadmap");
  EXPECT_EQ(
      refused(R"({"roadmap": "m.map", "agents": [], "tasks": []})"),
      "i.json: /roadmap: '" + (directory_ / "m.map") +
          "' has the suffix of a map; expected a roadmap, or this file under the key \"map\"");
}

TEST_F(InstanceFile, EveryTruncationIsRefused) {
  const std::string whole = "{" + kMap + ", " + kAgents + ", " + kTasks + "}";
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(refused(whole.substr(0, size)), "accepted") << size;
}

TEST_F(InstanceFile, RefusesOtherJsonValues) {
  EXPECT_EQ(refused("[]"), "i.json: /: found an array; expected a JSON object");
  EXPECT_EQ(refused("3"), "i.json: /: found a number; expected a JSON object");
  EXPECT_EQ(refused("null"), "i.json: /: found null; expected a JSON object");
}

TEST_F(InstanceFile, RefusesDeepNesting) {
  const std::string message = refused(std::string(100'000, '['));
  EXPECT_NE(message.find("nested too deeply; expected at most 32 levels"), std::string::npos);
  EXPECT_LT(message.size(), 200U);
  EXPECT_NE(refused("{\"x\": " + std::string(1'000'000, '[') + "}"), "accepted");
  std::string objects;
  for (int k = 0; k < 100'000; ++k) objects += "{\"k\":";
  EXPECT_NE(refused(objects).find("/k/k/k: nested too deeply"), std::string::npos);
}

TEST_F(InstanceFile, RefusesRepeatedKeys) {
  EXPECT_EQ(refused("{" + kMap + ", " + kMap + "}"),
            "i.json: /: key 'map' appears twice; expected distinct keys");
  EXPECT_EQ(
      refused_agents(R"([{"id": "a", "start": [0, 0]}, {"id": "b", "start": [0, 1], "id": "c"}])"),
      "i.json: /agents/1: key 'id' appears twice; expected distinct keys");
}

TEST_F(InstanceFile, RefusesMissingKeys) {
  EXPECT_EQ(refused("{}"),
            "i.json: /: key 'map' is missing; expected it, or 'roadmap', in this object");
  EXPECT_EQ(refused("{" + kMap + ", " + kTasks + "}"),
            "i.json: /: key 'agents' is missing; expected it in this object");
  EXPECT_EQ(refused("{" + kMap + ", " + kAgents + "}"),
            "i.json: /: key 'tasks' is missing; expected it in this object");
  EXPECT_EQ(refused_agent("{\"id\": \"a\"}"),
            "i.json: /agents/0: key 'start' is missing; expected it in this object");
  EXPECT_EQ(refused_agent("{\"start\": [0, 0]}"),
            "i.json: /agents/0: key 'id' is missing; expected it in this object");
  EXPECT_EQ(refused_tasks("[{\"id\": \"t\", \"cell\": [0, 0]}]"),
            "i.json: /tasks/0: key 'agents' is missing; expected it in this object");
}

TEST_F(InstanceFile, RefusesWrongTypes) {
  EXPECT_EQ(refused("{\"map\": 3}"), "i.json: /map: found 3; expected a string");
  EXPECT_EQ(refused("{\"map\": \"\"}"),
            "i.json: /map: found \"\"; expected the name of a map file");
  EXPECT_EQ(refused_agents("{}"), "i.json: /agents: found an object; expected an array");
  EXPECT_EQ(refused_agents("[7]"), "i.json: /agents/0: found 7; expected an object");
  EXPECT_EQ(refused_agent(R"({"id": 1, "start": [0, 0]})"),
            "i.json: /agents/0/id: found 1; expected a string");
  EXPECT_EQ(refused_agent(R"({"id": "a", "start": "x"})"),
            "i.json: /agents/0/start: found \"x\"; expected a cell [x, y]");
  EXPECT_EQ(refused_agent(R"({"id": "a", "start": [0]})"),
            "i.json: /agents/0/start: found an array; expected a cell [x, y]");
  EXPECT_EQ(refused_agent(R"({"id": "a", "start": [0, 0, 0]})"),
            "i.json: /agents/0/start: found an array; expected a cell [x, y]");
  EXPECT_EQ(refused_agent(R"({"id": "a", "start": [0, 0], "goal": null})"),
            "i.json: /agents/0/goal: found null; expected a cell [x, y]");
  EXPECT_EQ(
      refused_tasks(R"([{"id": "t", "cell": [2, 1], "agents": "a"}])"),
      "i.json: /tasks/0/agents: found \"a\"; expected a list of ids, or \"*\" for all agents");
  EXPECT_EQ(refused_tasks(R"([{"id": "t", "cell": [2, 1], "agents": [true]}])"),
            "i.json: /tasks/0/agents/0: found true; expected a string");
}

TEST_F(InstanceFile, RefusesInvalidCoordinates) {
  for (const char* wrong : {"1.5", "-1", "1.0", "99999999999", "18446744073709551615", "1e30",
                            "-9223372036854775808", "true", "\"1\"", "null", "[1]"})
    EXPECT_EQ(
        refused_agent(std::string(R"({"id": "a", "start": [0, )") + wrong + "]}").substr(0, 33),
        "i.json: /agents/0/start/1: found ")
        << wrong;
}

TEST_F(InstanceFile, RefusesInvalidInstances) {
  EXPECT_EQ(refused_agent(R"({"id": "a", "start": [0, 0], "goal": [1, 0]})"),
            "i.json: /agents/0/goal: cell [1, 0] is blocked on the map; expected a passable cell");
  EXPECT_EQ(refused_agent(R"({"id": "a", "start": [3, 0], "goal": [2, 0]})").substr(0, 30),
            "i.json: /agents/0/start: cell ");
  EXPECT_EQ(refused_agents(R"([{"id": "a", "start": [0, 0]}, {"id": "a", "start": [0, 1]}])"),
            "i.json: /agents/1/id: id 'a' is used twice; expected distinct ids");
  EXPECT_EQ(refused_agents(R"([{"id": "a", "start": [0, 0]}, {"id": "b", "start": [0, 0]}])")
                .substr(0, 25),
            "i.json: /agents/1/start: ");
  EXPECT_EQ(refused_agents("[]"), "i.json: /agents: expected at least one agent");
  EXPECT_EQ(refused("{" + kMap + R"(, "agents": [], "tasks": []})"),
            "i.json: /agents: expected at least one agent");
  EXPECT_EQ(refused_tasks(R"([{"id": "t", "cell": [2, 1], "agents": ["z"]}])"),
            "i.json: /tasks/0/agents/0: there is no agent 'z'; expected the id of an agent of this "
            "instance");
  EXPECT_EQ(refused_tasks(R"([{"id": "t", "cell": [2, 1], "agents": []}])").substr(0, 23),
            "i.json: /tasks/0/agents");
}

TEST_F(InstanceFile, QuotesIdsWithControlCharactersOnOneLine) {
  const std::string message = refused_agents(
      R"([{"id": "a\n\u0007ü", "start": [0, 0]}, {"id": "a\n\u0007ü", "start": [0, 1]}])");
  EXPECT_EQ(message, "i.json: /agents/1/id: id 'a\\n\\x07ü' is used twice; expected distinct ids");
}

TEST_F(InstanceFile, RefusesNulInStrings) {
  EXPECT_EQ(refused_agent(R"({"id": "a\u0000b", "start": [0, 0]})"),
            "i.json: /agents/0/id: found \"a\\u0000b\"; expected a string without NUL characters");
}

TEST_F(InstanceFile, NamesAnUnreadableMap) {
  EXPECT_EQ(refused("{\"map\": \"none.map\"}"), "i.json: /map: there is no file '" +
                                                    (directory_ / "none.map") +
                                                    "'; expected a map, relative to this file");
  EXPECT_TRUE(refused("{\"map\": \".\"}").starts_with("i.json: /map: found the folder"));
}

TEST_F(InstanceFile, RefusesFoldersAndMissingFiles) {
  EXPECT_NE(refusal([&] { read_instance(directory_.path()); }).find("is a folder; expected a file"),
            std::string::npos);
  EXPECT_EQ(refusal([&] { read_instance(directory_ / "none.json"); }),
            "none.json: cannot be read: No such file or directory");
}

}  // namespace instance_file_test
}  // namespace grove::detail
