// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace convert_command_test {

using Arguments = std::vector<std::string>;

// . @ . . .   Wider than high, and without symmetries.
// . . . . .
// . . . @ @
const std::string kMap = "type octile\nheight 3\nwidth 5\nmap\n.@...\n.....\n...@@\n";

const std::string kPlain =
    "{\n \"map\": \"m.map\",\n \"agents\": [\n  {\"id\":\"a0\",\"start\":[0,0],\"goal\":[4,0]},\n"
    "  {\"id\":\"a1\",\"start\":[3,0],\"goal\":[1,2]}],\n \"tasks\": []}\n";
const std::string kTasks =
    "{\n \"map\": \"m.map\",\n \"agents\": [\n  {\"id\":\"a0\",\"start\":[0,0],\"goal\":[4,0]},\n"
    "  {\"id\":\"a1\",\"start\":[3,0],\"goal\":[1,2]}],\n \"tasks\": [\n"
    "  {\"id\":\"t0\",\"cell\":[2,1],\"agents\":[\"a0\",\"a1\"]},\n"
    "  {\"id\":\"t1\",\"cell\":[0,1],\"agents\":[\"a1\"]}]}\n";
const std::string kMg =
    "{\n \"map\": \"m.map\",\n \"agents\": [\n  {\"id\":\"red\",\"start\":[0,0]}],\n"
    " \"tasks\": [\n  {\"id\":\"t0\",\"cell\":[4,1],\"agents\":[\"red\"]}]}\n";
const std::string kPlainYaml =
    "map:\n  dimensions: [5, 3]\n  obstacles:\n    - [1, 0]\n    - [3, 2]\n    - [4, 2]\n"
    "agents:\n  - name: a0\n    start: [0, 0]\n    goal: [4, 0]\n"
    "  - name: a1\n    start: [3, 0]\n    goal: [1, 2]\n";
const std::string kScen =
    "version 1\n1\tm.map\t5\t3\t0\t0\t4\t0\t6\n1\tm.map\t5\t3\t3\t0\t1\t2\t4\n";
const std::string kPlan =
    R"({"status": "optimal", "cost": 10, "lower_bound": 10, "omega": 0, "agents": [
  {"id": "a0", "sequence": [], "cost": 6, "path": [[0,0],[0,1],[1,1],[2,1],[3,1],[4,1],[4,0]]},
  {"id": "a1", "sequence": [], "cost": 4, "path": [[3,0],[2,0],[2,1],[2,2],[1,2]]}]})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

class ConvertCommand : public ::testing::Test {
 protected:
  ConvertCommand() {
    directory_.write("m.map", kMap);
    directory_.write("plain.cts.json", kPlain);
    directory_.write("tasks.cts.json", kTasks);
    directory_.write("mg.cts.json", kMg);
    directory_.write("plain.yaml", kPlainYaml);
    directory_.write("plain.scen", kScen);
    directory_.write("p.json", kPlan);
  }

  ProcessResult run(Arguments arguments) const {
    arguments.insert(arguments.begin(), "convert");
    return run_grove(arguments, {.directory = directory_.path().string()});
  }
  // Converts, expects success and returns the output.
  std::string converted(const Arguments& arguments) const {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    return result.out;
  }
  // Expects a refusal that neither creates nor changes a file, and returns the message.
  std::string refused(const Arguments& arguments) const {
    const auto files = directory_.files();
    const std::string text = complaint(run(arguments));
    EXPECT_EQ(directory_.files(), files);
    return text;
  }
  std::string content(const std::string& name) const { return file_content(directory_ / name); }

  TemporaryDirectory directory_;
};

const std::string kHint = " (see 'grove convert --help')";

TEST_F(ConvertCommand, GroveToLibmrpAndBack) {
  EXPECT_EQ(converted({"plain.cts.json", "o.yaml"}), "wrote o.yaml: 2 agents, 0 tasks\n");
  EXPECT_EQ(content("o.yaml"), kPlainYaml);
  EXPECT_EQ(converted({"o.yaml", "back.cts.json"}),
            "wrote back.map: 5 x 3 cells\nwrote back.cts.json: 2 agents, 0 tasks\n");
  EXPECT_EQ(content("back.cts.json"), replaced(kPlain, "m.map", "back.map"));
  EXPECT_EQ(content("back.map"), kMap);
}

TEST_F(ConvertCommand, GroveToMgcbsAndBack) {
  converted({"mg.cts.json", "o.yaml", "--to", "mgcbs"});
  EXPECT_EQ(content("o.yaml").substr(content("o.yaml").find("agents:")),
            "agents:\n  - name: red\n    start: [0, 0]\n    goals:\n      - [4, 1]\n");
  converted({"o.yaml", "back.cts.json", "--map", "m.map"});
  EXPECT_EQ(content("back.cts.json"), kMg);
}

TEST_F(ConvertCommand, GroveToPotentialGoalsAndBack) {
  const std::string targets = replaced(kPlain, R"("goal":[4,0])", R"("goals":[[4,0],[1,2]])");
  directory_.write("targets.cts.json", targets);
  EXPECT_EQ(converted({"targets.cts.json", "o.yaml", "--to", "potential-goals"}),
            "wrote o.yaml: 2 agents, 0 tasks\n");
  EXPECT_EQ(content("o.yaml").substr(content("o.yaml").find("agents:")),
            "agents:\n  - name: a0\n    start: [0, 0]\n    potentialGoals:\n      - [4, 0]\n"
            "      - [1, 2]\n  - name: a1\n    start: [3, 0]\n    potentialGoals:\n"
            "      - [1, 2]\n");
  for (const Arguments& from : {Arguments{}, Arguments{"--from", "potential-goals"}}) {
    Arguments arguments = {"o.yaml", "back.cts.json", "--map", "m.map"};
    arguments.insert(arguments.end(), from.begin(), from.end());
    converted(arguments);
    EXPECT_EQ(content("back.cts.json"), targets);
  }
  // The map of a file that names one, with cells [row, column].
  directory_.write("rows.yaml",
                   "agents:\n- {name: a0, start: [0, 0], potentialGoals: [[0, 4], [2, 1]]}\n"
                   "- {name: a1, start: [0, 3], potentialGoals: [[2, 1]]}\nmap: m.map\n");
  EXPECT_EQ(converted({"rows.yaml", "rows.cts.json"}),
            "wrote rows.map: 5 x 3 cells\nwrote rows.cts.json: 2 agents, 0 tasks\n");
  EXPECT_EQ(replaced(content("rows.cts.json"), "rows.map", "m.map"), targets);
  EXPECT_EQ(content("rows.map"), kMap);
}

TEST_F(ConvertCommand, ChoicesAreNeverDropped) {
  directory_.write("targets.cts.json",
                   replaced(kPlain, R"("goal":[4,0])", R"("goals":[[4,0],[0,0]])"));
  EXPECT_EQ(refused({"targets.cts.json", "o.yaml"}),
            "targets.cts.json: /agents/0/goals: agent 'a0' has a choice of goals, which cannot be "
            "represented in libMultiRobotPlanning's YAML for CBS; expected the format "
            "potential-goals (CBS-TA), or 'goal'");
  const std::string chooses =
      "targets.cts.json: /agents/0/goals: agent 'a0' has a choice of goals, which ";
  for (const std::string to : {"o.scen", "o.mapfw.json"})
    EXPECT_EQ(refused({"targets.cts.json", to}).substr(0, chooses.size()), chooses);
  directory_.write("need.cts.json",
                   replaced(kTasks, R"("agents":["a0","a1"])", R"("agents":"*","need":1)"));
  const std::string needs =
      "need.cts.json: /tasks/0/need: task 't0' has a choice of agents, which ";
  EXPECT_EQ(refused({"need.cts.json", "o.mapfw.json"}).substr(0, needs.size()), needs);
  EXPECT_EQ(refused({"need.cts.json", "o.mapfw.json", "--drop", "ids"}).substr(0, needs.size()),
            needs);
  EXPECT_EQ(refused({"need.cts.json", "o.yaml", "--to", "mgcbs"}).substr(0, needs.size()), needs);
  EXPECT_EQ(refused({"need.cts.json", "o.yaml", "--to", "potential-goals"}),
            "need.cts.json: /tasks/0: task 't0' cannot be represented in libMultiRobotPlanning's "
            "YAML; expected no tasks (--drop tasks leaves the tasks out)");
  converted({"need.cts.json", "o.scen", "--drop", "tasks"});
  EXPECT_EQ(content("o.scen"), kScen);
  converted({"need.cts.json", "again.cts.json"});
  EXPECT_EQ(content("again.cts.json"), content("need.cts.json"));
  directory_.write("choice.yaml",
                   "agents:\n- {name: a0, start: [0, 0], potentialGoals: [[0, 4], [2, 1]]}\n"
                   "map: m.map\n");
  const std::string of_yaml = "choice.yaml: /agents/0/potentialGoals: agent 'a0' has a choice ";
  EXPECT_EQ(refused({"choice.yaml", "o.scen"}).substr(0, of_yaml.size()), of_yaml);
}

TEST_F(ConvertCommand, GroveToMapfwAndBack) {
  converted({"tasks.cts.json", "o.mapfw.json"});
  converted({"o.mapfw.json", "back.cts.json", "--map", "m.map"});
  EXPECT_EQ(content("back.cts.json"), kTasks);
}

TEST_F(ConvertCommand, GroveToScenAndBack) {
  converted({"plain.cts.json", "o.scen"});
  EXPECT_EQ(content("o.scen"), kScen);
  converted({"o.scen", "--map", "m.map", "back.cts.json"});
  EXPECT_EQ(content("back.cts.json"), kPlain);
  EXPECT_EQ(converted({"o.scen", "--map", "m.map", "--agents", "1", "one.cts.json"}),
            "wrote one.cts.json: 1 agents, 0 tasks\n");
}

TEST_F(ConvertCommand, YamlToScenWritesTheMapNextToIt) {
  EXPECT_EQ(converted({"plain.yaml", "o.scen"}),
            "wrote o.map: 5 x 3 cells\nwrote o.scen: 2 agents, 0 tasks\n");
  EXPECT_EQ(content("o.map"), kMap);
  EXPECT_EQ(content("o.scen"), replaced(replaced(kScen, "m.map", "o.map"), "m.map", "o.map"));
}

TEST_F(ConvertCommand, MapPathIsRelativeToTheOutput) {
  std::filesystem::create_directory(directory_.path() / "below");
  converted({"plain.cts.json", "below/o.cts.json"});
  EXPECT_EQ(content("below/o.cts.json"), replaced(kPlain, "m.map", "../m.map"));
}

TEST_F(ConvertCommand, MapsAreNotOverwritten) {
  converted({"plain.yaml", "m.cts.json"});  // m.map has the same cells, so the instance names it
  EXPECT_EQ(content("m.cts.json"), kPlain);
  const std::string other = replaced(kMap, ".@...", "..@..");
  directory_.write("o.map", other);
  EXPECT_EQ(refused({"plain.yaml", "o.cts.json"}),
            "o.map: is not the map of 'plain.yaml'; expected the same 5 x 3 cells");
  EXPECT_EQ(content("o.map"), other);
  EXPECT_EQ(refused({"plain.yaml", "x.cts.json", "--map", "o.map"}).substr(0, 21),
            "o.map: is not the map");
  EXPECT_EQ(refused({"plain.cts.json", "x.cts.json", "--map", "o.map"}).substr(0, 21),
            "o.map: is not the map");
}

TEST_F(ConvertCommand, TerrainIsReadAsBySolve) {
  directory_.write("m.map", replaced(replaced(kMap, ".@...", "GTSE."), "...@@", "...OW"));
  EXPECT_EQ(run({"plain.cts.json", "o.yaml"}).exit_code, 0);
  EXPECT_EQ(content("o.yaml"), kPlainYaml);
}

TEST_F(ConvertCommand, TasksAreDroppedOnlyOnRequest) {
  const std::string problem =
      "tasks.cts.json: /tasks/0: task 't0' cannot be represented in a .scen file; expected no "
      "tasks "
      "(--drop tasks leaves the tasks out)";
  EXPECT_EQ(refused({"tasks.cts.json", "o.scen"}), problem);
  EXPECT_EQ(refused({"tasks.cts.json", "o.scen", "--drop", "ids"}), problem);
  EXPECT_EQ(converted({"tasks.cts.json", "o.scen", "--drop", "tasks"}),
            "wrote o.scen: 2 agents, 0 tasks\n");
  EXPECT_EQ(content("o.scen"), kScen);
  converted({"--drop", "tasks", "tasks.cts.json", "o.yaml"});
  EXPECT_EQ(content("o.yaml"), kPlainYaml);
  // Whatever the format can represent is kept in spite of --drop.
  converted({"tasks.cts.json", "o.cts.json", "--drop", "ids,tasks"});
  EXPECT_EQ(content("o.cts.json"), kTasks);
}

TEST_F(ConvertCommand, IdsAreDroppedOnlyOnRequest) {
  directory_.write("red.cts.json", replaced(kPlain, "a1", "red"));
  EXPECT_EQ(refused({"red.cts.json", "o.scen"}),
            "red.cts.json: /agents/1: a .scen file has no ids: read back, agent 'red' would be "
            "'a1'; expected this id (--drop ids leaves the ids out)");
  converted({"red.cts.json", "o.scen", "--drop", "ids"});
  EXPECT_EQ(content("o.scen"), kScen);
  converted({"red.cts.json", "o.yaml", "--drop", "ids"});
  EXPECT_EQ(content("o.yaml"), replaced(kPlainYaml, "a1", "red"));
  directory_.write("shelf.cts.json", replaced(kMg, "t0", "shelf"));
  EXPECT_EQ(refused({"shelf.cts.json", "o.yaml", "--to", "mgcbs"}),
            "shelf.cts.json: /tasks/0: MGCBS's YAML has no ids of tasks: read back, task 'shelf' "
            "(number 0) would be 't0' (number 0); expected that (--drop ids leaves the ids out)");
  converted({"shelf.cts.json", "o.yaml", "--to", "mgcbs", "--drop", "ids"});
  EXPECT_NE(content("o.yaml").find("name: red"), std::string::npos);
}

TEST_F(ConvertCommand, MessageNamesThePlaceInEachFormat) {
  converted({"mg.cts.json", "mg.yaml", "--to", "mgcbs"});
  converted({"tasks.cts.json", "tasks.mapfw.json"});
  const auto starts = [&](const Arguments& arguments, const std::string& start) {
    const std::string text = refused(arguments);
    EXPECT_EQ(text.substr(0, start.size()), start);
  };
  starts({"mg.cts.json", "o.yaml"}, "mg.cts.json: /agents/0: agent 'red' has no goal; ");
  starts({"mg.cts.json", "o.scen", "--drop", "tasks"},
         "mg.cts.json: /agents/0: agent 'red' has no goal; ");
  starts({"mg.yaml", "o.mapfw.json"}, "mg.yaml: /agents/0: agent 'red' has no goal; ");
  starts({"plain.yaml", "o.yml", "--to", "mgcbs"},
         "plain.yaml: /agents/0: agent 'a0' has a goal to end on, ");
  starts({"tasks.mapfw.json", "o.scen"}, "tasks.mapfw.json: /waypoints/0: task 't0' cannot be ");
  starts({"tasks.mapfw.json", "o.yaml", "--to", "mgcbs"},
         "tasks.mapfw.json: /starts/0: agent 'a0' has a goal to end on, ");
  starts({"plain.scen", "--map", "m.map", "o.yaml", "--to", "mgcbs"},
         "plain.scen: line 2: agent 'a0' has a goal to end on, ");
}

TEST_F(ConvertCommand, WritesNoMapIfTheInstanceFails) {
  directory_.write("cut.yaml",
                   "map: {dimensions: [3, 1], obstacles: [[1, 0]]}\n"
                   "agents: [{name: a0, start: [0, 0], goal: [2, 0]}]\n");
  EXPECT_EQ(refused({"cut.yaml", "o.scen"}),
            "cut.yaml: /agents/0: agent 'a0' cannot reach its goal; expected a path, because a "
            ".scen file has its length");
  EXPECT_EQ(refused({"plain.yaml", "none/o.cts.json"}),
            "none/o.cts.json: cannot be written: No such file or directory");
  directory_.write("two words.yaml", kPlainYaml);
  EXPECT_EQ(refused({"plain.yaml", "two words.scen"}),
            "two words.scen: the map's name 'two words.map' contains blanks; expected none, "
            "because they separate the columns of a .scen file");
}

TEST_F(ConvertCommand, OverwritesNoneOfItsInputs) {
  EXPECT_EQ(refused({"plain.yaml", "./plain.yaml"}),
            "./plain.yaml: is the instance; expected another file to write to");
  EXPECT_EQ(refused({"--plan", "p.json", "plain.cts.json", "p.json", "--to", "eecbs"}),
            "p.json: is the plan; expected another file to write to");
  EXPECT_EQ(refused({"plain.cts.json", "m.map", "--to", "libmrp"}),
            "m.map: is the map; expected another file to write to");
  EXPECT_EQ(content("m.map"), kMap);
}

TEST_F(ConvertCommand, FormatsAreDerivedOnlyFromKnownFileNames) {
  directory_.write("x.json", kTasks);
  EXPECT_EQ(
      refused({"x.json", "o.yaml"}),
      "--from: required, because the suffix of 'x.json' is not that of a format; expected one of "
      "grove, libmrp, potential-goals, mgcbs, mapfw, scen" +
          kHint);
  EXPECT_EQ(refused({"plain.yaml", "o.txt"}),
            "--to: required, because the suffix of 'o.txt' is not that of a format; expected one "
            "of grove, "
            "libmrp, potential-goals, mgcbs, mapfw, scen" +
                kHint);
  EXPECT_EQ(
      refused({"--plan", "p.json", "plain.yaml", "o.txt"}),
      "--to: required, because the suffix of 'o.txt' is not that of a format; expected one of "
      "libmrp, mapf-visualizer, eecbs, tracker, tracker-csv, waypoints, nav-path, planviz" +
          kHint);
  EXPECT_EQ(
      refused({"--from", "grv", "x.json", "o.yaml"}),
      "--from: found 'grv'; expected one of grove, libmrp, potential-goals, mgcbs, mapfw, scen" +
          kHint);
  EXPECT_EQ(converted({"--from", "grove", "x.json", "--to", "mapfw", "o.txt"}),
            "wrote o.txt: 2 agents, 2 tasks\n");
}

TEST_F(ConvertCommand, OptionsWithoutEffectAreRefused) {
  const auto said = [&](const Arguments& arguments) {
    const std::string text = refused(arguments);
    return text.substr(0, text.size() - std::min(text.size(), kHint.size()));
  };
  EXPECT_EQ(said({"plain.scen", "o.yaml"}), "--map: required with a .scen INSTANCE");
  EXPECT_EQ(said({"plain.yaml", "o.cts.json", "--agents", "1"}),
            "--agents: allowed only with a .scen INSTANCE");
  EXPECT_EQ(said({"plain.yaml", "o.mapfw.json", "--map", "m.map"}),
            "--map: allowed only with a .scen INSTANCE, or an OUT with a map");
  EXPECT_EQ(said({"plain.yaml", "o.cts.json", "--scenario", "even-1"}),
            "--scenario: allowed only with --plan and --to tracker");
  EXPECT_EQ(said({"plain.yaml", "o.cts.json", "--flip-up-down"}),
            "--flip-up-down: allowed only with --plan and --to tracker");
  EXPECT_EQ(said({"--plan", "p.json", "plain.yaml", "o.yaml", "--drop", "ids"}),
            "--drop: allowed only with instances, not with --plan");
  EXPECT_EQ(said({"--plan", "p.json", "plain.yaml", "o.yaml", "--map", "m.map"}),
            "--map: allowed only with a .scen INSTANCE");
  EXPECT_EQ(said({"plain.yaml", "o.cts.json", "--drop", "agents"}),
            "--drop: found 'agents'; expected ids, tasks or ids,tasks");
  EXPECT_EQ(said({"--plan", "p.json", "plain.yaml", "o.csv", "--scenario", "even-1"}),
            "--to: a row of MAPF Tracker names a map of Moving AI; expected an INSTANCE with a map "
            "file");
  EXPECT_EQ(said({"--plan", "p.json", "plain.cts.json", "o.csv", "--scenario", "odd-1"}),
            "--scenario: found 'odd-1'; expected even-N or random-N");
  EXPECT_EQ(said({"--plan", "p.json", "plain.cts.json", "o.csv"}),
            "--scenario: required; expected even-N or random-N: the scenario whose first rows are "
            "the agents");
}

TEST_F(ConvertCommand, ConvertsPlans) {
  EXPECT_EQ(converted({"--plan", "p.json", "plain.cts.json", "o.txt", "--to", "eecbs"}),
            "wrote o.txt: 2 paths, cost 10\n");
  EXPECT_EQ(content("o.txt"),
            "Agent 0: (0,0)->(1,0)->(1,1)->(1,2)->(1,3)->(1,4)->(0,4)->\n"
            "Agent 1: (0,3)->(0,2)->(1,2)->(2,2)->(2,1)->\n");
  converted({"--plan", "p.json", "plain.yaml", "o.txt", "--to", "mapf-visualizer"});
  EXPECT_EQ(content("o.txt"),
            "agents=2\nmap_file=plain.map\nsolver=grove\nsolved=1\nsoc=10\nsoc_lb=10\nmakespan=6\n"
            "makespan_lb=6\nsum_of_loss=10\nsum_of_loss_lb=10\nstarts=(0,0),(3,0),\n"
            "goals=(4,0),(1,2),\nsolution=\n0:(0,0),(3,0),\n1:(0,1),(2,0),\n2:(1,1),(2,1),\n"
            "3:(2,1),(2,2),\n4:(3,1),(1,2),\n5:(4,1),(1,2),\n6:(4,0),(1,2),\n");
  converted({"--plan", "p.json", "plain.cts.json", "o.yaml"});
  EXPECT_EQ(content("o.yaml").substr(0, 97),
            "statistics:\n  cost: 10\n  makespan: 6\nschedule:\n  a0:\n"
            "    - x: 0\n      y: 0\n      t: 0\n    - x: 0\n");
  converted({"--plan", "p.json", "plain.scen", "--map", "m.map", "o.json", "--to", "tracker",
             "--scenario", "random-3", "--flip-up-down"});
  EXPECT_EQ(content("o.json"),
            R"([{"map_name":"m","scen_type":"random","type_id":3,"agents":2,"lower_cost":10,)"
            R"("solution_cost":10,"flip_up_down":true,"solution_plan":"u4rd\nl2ul"}])"
            "\n");
}

TEST_F(ConvertCommand, TrackerScenarioComesFromTheFileName) {
  directory_.write("m-even-12.scen", kScen);
  converted({"--plan", "p.json", "m-even-12.scen", "--map", "m.map", "o.csv"});
  EXPECT_EQ(
      content("o.csv"),
      "map_name,scen_type,type_id,agents,lower_cost,solution_cost,flip_up_down,solution_plan\n"
      "\"m\",\"even\",12,2,10,10,FALSE,\"d4ru\nl2dl\"\n");
}

TEST_F(ConvertCommand, InvalidPlansAreRefused) {
  directory_.write("wrong.json", replaced(kPlan, "[2,0],[2,1]", "[2,1],[2,1]"));
  EXPECT_EQ(refused({"--plan", "wrong.json", "plain.cts.json", "o.yaml"}),
            "wrong.json: /agents/1/path/1: agent 'a1' jumps from [3, 0] to [2, 1]; expected a wait "
            "or a move to one of 4 neighbors");
  EXPECT_EQ(refused({"--plan", "p.json", "tasks.cts.json", "o.yaml"}).substr(0, 8), "p.json: ");
  directory_.write("none.json", R"({"status": "unknown", "lower_bound": 3, "omega": 0})");
  EXPECT_EQ(refused({"--plan", "none.json", "plain.cts.json", "o.yaml"}),
            "none.json: /status: there is no plan ('unknown'); expected a path for every agent");
  directory_.write("t.json", R"({"status": "optimal", "cost": 5, "lower_bound": 5, "omega": 0,
    "agents": [{"id": "red", "sequence": ["t0"], "cost": 5,
                "path": [[0,0],[0,1],[1,1],[2,1],[3,1],[4,1]]}]})");
  EXPECT_EQ(refused({"--plan", "t.json", "mg.cts.json", "o.csv"}),
            "mg.cts.json: /agents/0: agent 'red' has no goal; expected one for every agent, "
            "because a row of MAPF Tracker requires it");
}

// Other tests fuzz the readers; this test checks the messages for broken files.
TEST_F(ConvertCommand, BrokenFilesAreRefusedInOneLine) {
  converted({"tasks.cts.json", "tasks.mapfw.json"});
  std::mt19937 random(7);
  for (const std::string name : {"plain.yaml", "tasks.mapfw.json"}) {
    const std::string whole = content(name);
    const std::string broken = "broken" + name.substr(name.find('.'));
    for (int k = 0; k < 20; ++k) {
      std::string text = whole;
      text[random() % text.size()] = static_cast<char>(random() % 256);
      text.erase(random() % text.size(), 3);
      directory_.write(broken, text);
      const ProcessResult result = run({broken, "o.cts.json"});
      EXPECT_TRUE(result.exit_code == 0 || complaint(result).starts_with(broken + ": "))
          << result.exit_code << result.err << text;
    }
  }
}

}  // namespace convert_command_test
}  // namespace grove::detail
