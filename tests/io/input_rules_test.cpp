// SPDX-License-Identifier: MIT
// Tests file names that lead out of a folder, and small files that would need gigabytes of memory.
// tests/tools/common/hostile_files_test.py tests the same rules through the programs.
#include "io/input_rules.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "io/instance_file.h"
#include "io/libmrp_file.h"
#include "io/map_file.h"
#include "io/road_network.h"
#include "io/roadmap_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace input_rules_test {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr InputRules kConfined{.confined = true};
constexpr InputRules kLittle{.memory = 100'000'000};
constexpr std::string_view kMap = "type octile\nheight 1\nwidth 2\nmap\n..\n";

class InputRulesTest : public ::testing::Test {
 protected:
  std::string named(const std::string& name) const {
    try {
      return file_in_folder(kConfined, directory_ / "folder", name).string();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }
  std::string refused(const std::string& agents_and_tasks,
                      const InputRules& rules = kLittle) const {
    const std::string text = R"({"map": "m.map", )" + agents_and_tasks + "}";
    return refusal([&] { parse_instance(text, "i.json", directory_.path(), rules); });
  }

  const TemporaryDirectory directory_;
};

TEST_F(InputRulesTest, ConfinedNamesStayInTheFolder) {
  const fs::path folder = directory_ / "folder";
  fs::create_directories(folder / "below");
  directory_.write("out.map", kMap);
  directory_.write("folder/below/in.map", kMap);
  fs::create_symlink("../out.map", folder / "link.map");
  fs::create_symlink("..", folder / "up");
  fs::create_symlink("below/in.map", folder / "near.map");
  for (const char* name :
       {"../out.map", "link.map", "up/out.map", "up/folder/../out.map", "..", "."})
    EXPECT_THAT(named(name), HasSubstr("leads outside the folder of this file")) << name;
  EXPECT_THAT(named((folder / "below/in.map").string()), HasSubstr("is an absolute path"));
  const std::string inside = fs::canonical(folder / "below/in.map").string();
  for (const char* name :
       {"below/in.map", "near.map", "below/../below/in.map", "up/folder/near.map"})
    EXPECT_EQ(named(name), inside) << name;
  EXPECT_EQ(file_in_folder({}, folder, "../out.map"), fs::path(directory_ / "out.map"));
}

TEST_F(InputRulesTest, LargeInputsAreRefusedBeforeAllocation) {
  constexpr std::string_view kRoads =
      R"({"vertices": [{"id": "A", "at": [0, 0]}, {"id": "B", "at": [1, 0]}],
    "edges": [{"from": "A", "to": "B", "steps": 67000000}]})";
  EXPECT_THAT(refusal([&] { parse_roadmap(kRoads, "r.json", kLittle); }),
              HasSubstr("r.json: /edges/0: 67000001 places of the roads up to this one need about "
                        "8.6 GB of memory; expected at most 0.1 GB, the memory limit"));
  const RoadNetwork network{"n", {{"A", {}}, {"B", {}}}, {{0, 1, false, 67e6, {}, "line 1"}}};
  EXPECT_THAT(refusal([&] { in_steps(network, {.metres_per_step = 1}, kLittle); }),
              HasSubstr("n: line 1: 67000001 places"));
  const std::string map =
      directory_.write("large.map", "type octile\nheight 8000\nwidth 8000\nmap\n");
  EXPECT_THAT(refusal([&] { read_map(map, nullptr, kLittle); }), HasSubstr("64000000 cells need"));
  const std::string yaml =
      directory_.write("i.yaml", "map: {dimensions: [4000, 4000], obstacles: []}\n");
  EXPECT_THAT(refusal([&] { read_libmrp_instance(yaml, nullptr, kLittle); }),
              HasSubstr("16000000 cells need"));
}

TEST_F(InputRulesTest, StatesOfTurnsAndWorkCount) {
  directory_.write("m.map", kMap);
  const std::string turning = R"("agents": [{"id": "a", "start": [0, 0], "motion": "turning",
    "heading": "N", "turn_steps": 65536, "goal": [1, 0]}], "tasks": [])";
  EXPECT_EQ(refused(turning, {}), "accepted");
  EXPECT_EQ(refused(turning), "accepted");  // one million states
  std::string tasks;
  for (int i = 0; i < 30; ++i)
    tasks += (i > 0 ? ", " : "") + std::string(R"({"id": "t)") + std::to_string(i) +
             R"(", "cell": [1, 0], "agents": ["a"], "duration": 65536})";
  EXPECT_THAT(refused(R"("agents": [{"id": "a", "start": [0, 0]}], "tasks": [)" + tasks + "]"),
              HasSubstr("states of agents that turn or work need about"));
}

TEST_F(InputRulesTest, TasksOfAllAgentsCount) {
  directory_.write("m.map",
                   "type octile\nheight 1\nwidth 2000\nmap\n" + std::string(2000, '.') + "\n");
  std::string agents;
  std::string tasks;
  for (int i = 0; i < 2000; ++i) {
    const std::string_view comma = i > 0 ? ", " : "";
    agents += fmt::format(R"({}{{"id": "a{}", "start": [{}, 0]}})", comma, i, i);
    tasks +=
        fmt::format(R"({}{{"id": "t{}", "cell": [0, 0], "agents": "*", "need": 1}})", comma, i);
  }
  const std::string text = R"("agents": [)" + agents + R"(], "tasks": [)" + tasks + "]";
  EXPECT_EQ(refused(text, {}), "accepted");
  EXPECT_EQ(refused(text),
            "i.json: /tasks/781: 1564000 agents of tasks need about 0.1 GB of memory; expected at "
            "most 0.1 GB, the memory limit");
}

TEST_F(InputRulesTest, SmallInstancesAreReadWithAnyMemoryLimit) {
  directory_.write("m.map", kMap);
  EXPECT_EQ(refused(R"("agents": [{"id": "a", "start": [0, 0]}], "tasks": [])", {.memory = 0}),
            "accepted");
}

TEST_F(InputRulesTest, OtherFilesAreNotQuoted) {
  for (const char* text : {"root:secret:1\n", "type secret\n", "{\"secret\": 1}"}) {
    directory_.write("m.map", text);
    EXPECT_THAT(refused(R"("agents": [], "tasks": [])"), Not(HasSubstr("secret"))) << text;
  }
  EXPECT_THAT(refusal([] { parse_roadmap("\"secret\"", "r"); }), Not(HasSubstr("secret")));
  EXPECT_EQ(refusal([] { parse_roadmap(R"({"secret": {"edges": 1}})", "r"); }),
            "r: /: has none of the keys vertices, edges; expected a roadmap");
  EXPECT_THAT(refusal([] { parse_roadmap(R"({"nodes": []})", "r"); }),
              HasSubstr("unknown key 'nodes'; expected 'vertices'"));
}

}  // namespace input_rules_test
}  // namespace grove::detail
