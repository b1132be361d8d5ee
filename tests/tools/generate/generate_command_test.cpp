// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "io/instance_file.h"
#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace generate_command_test {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

// Runs `grove generate` in `directory` with the arguments, which are separated by spaces.
ProcessResult generate(const TemporaryDirectory& directory, const std::string& arguments) {
  ProcessOptions options;
  options.directory = directory.path().string();
  std::vector<std::string> words = words_of("generate " + arguments);
  return run_grove(std::move(words), options);
}

TEST(ShippedData, IsTheOutputOfTheCommandsInItsReadme) {
  const TemporaryDirectory directory;
  const fs::path data = GROVE_DATA;
  const std::string command_start = "grove generate ";
  for (const std::string& line : lines_of(file_content(data / "README.md"))) {
    if (!line.starts_with(command_start)) continue;
    const ProcessResult result = generate(directory, line.substr(command_start.size()));
    ASSERT_EQ(result.exit_code, 0) << line << "\n" << result.err;
  }
  EXPECT_GE(directory.files().size(), 12U);
  for (const std::string& name : directory.files())
    EXPECT_EQ(file_content(directory / name), file_content(data / name)) << name;
}

TEST(ShippedData, ContainsOnlyFilesNamedInItsReadme) {
  const std::string readme = file_content(fs::path(GROVE_DATA) / "README.md");
  for (const auto& entry : fs::directory_iterator(GROVE_DATA))
    EXPECT_NE((readme + "README.md").find(entry.path().filename().string()), std::string::npos)
        << entry.path();
}

TEST(ShippedData, IsReadWithoutWarnings) {
  int instances = 0;
  for (const auto& entry : fs::directory_iterator(GROVE_DATA)) {
    if (!entry.path().string().ends_with(".cts.json")) continue;
    EXPECT_TRUE(read_instance(entry.path()).warnings.empty()) << entry.path();
    ++instances;
  }
  EXPECT_GE(instances, 5);
}

TEST(GenerateCommand, MakesAnInstanceFromOnlyAMap) {
  const TemporaryDirectory directory;
  EXPECT_EQ(generate(directory, "map random --seed 3 -o my.map").out,
            "wrote my.map: 32 x 32 cells, 819 passable\n");
  EXPECT_EQ(
      generate(directory, "instance --map my.map --agents 5 --tasks 10 --mg -o my.cts.json").out,
      "wrote my.cts.json: 5 agents, 15 tasks\n");
  EXPECT_EQ(read_instance(directory / "my.cts.json").instance.agent_count(), 5);
}

TEST(GenerateCommand, StoresTheMapRelativeToTheInstance) {
  const TemporaryDirectory directory;
  fs::create_directories(directory / "maps");
  fs::create_directories(directory / "sets/a");
  generate(directory, "map empty -o maps/my.map");
  generate(directory, "instance --map maps/my.map --agents 1 --tasks 1 -o sets/a/my.cts.json");
  EXPECT_NE(file_content(directory / "sets/a/my.cts.json").find("\"map\": \"../../maps/my.map\""),
            std::string::npos);
  EXPECT_EQ(read_instance(directory / "sets/a/my.cts.json").instance.agent_count(), 1);
}

TEST(GenerateCommand, MakesADatasetWithItsManifest) {
  const TemporaryDirectory directory;
  generate(directory, "map rooms --seed 1 -o my.map");
  generate(directory, "scenario --map my.map --rows 60 --seed 1 -o my-random-1.scen");
  generate(directory, "scenario --map my.map --rows 60 --seed 7 -o my-random-7.scen");
  const ProcessResult result =
      generate(directory,
               "dataset --map my.map --scen my-random-7.scen my-random-1.scen --agents 5,10 "
               "--tasks 10,20,30 --seed 2 --output-dir out/set");
  EXPECT_EQ(result.out, "wrote out/set/manifest.txt: 12 instances\n") << result.err;
  const auto names = lines_of(file_content(directory / "out/set/manifest.txt"));
  ASSERT_EQ(names.size(), 12U);
  EXPECT_EQ(names[0], "my_s7_n5_m10.cts.json");
  EXPECT_EQ(names[11], "my_s1_n10_m30.cts.json");
  for (const std::string& name : names)
    EXPECT_GT(read_instance(directory.path() / "out/set" / name).instance.task_count(), 0);

  fs::create_directories(directory / "a/b");
  generate(directory,
           "instance --map my.map --scen my-random-1.scen --agents 10 --tasks 30 --seed 2 -o "
           "a/b/one.cts.json");
  EXPECT_EQ(file_content(directory / "a/b/one.cts.json"),
            file_content(directory / "out/set/my_s1_n10_m30.cts.json"));
}

TEST(GenerateCommand, DrawsScenariosForADatasetFromOnlyAMap) {
  const TemporaryDirectory directory;
  generate(directory, "map empty -o my.map");
  EXPECT_EQ(generate(directory,
                     "dataset --map my.map --scenarios 2 --agents 5 --tasks 10 --mg --output-dir .")
                .exit_code,
            0);
  EXPECT_EQ(file_content(directory / "manifest.txt"),
            "my_s1_n5_m10_mg.cts.json\nmy_s2_n5_m10_mg.cts.json\n");
  EXPECT_NE(file_content(directory / "my_s1_n5_m10_mg.cts.json"),
            file_content(directory / "my_s2_n5_m10_mg.cts.json"));
}

TEST(GenerateCommand, MakesRoadmapsAndInstancesOnThem) {
  const TemporaryDirectory directory;
  EXPECT_EQ(
      generate(directory, "roadmap --kind planar --vertices 40 --one-way 25 -o a.roadmap.json")
          .out.substr(0, 35),
      "wrote a.roadmap.json: 40 vertices, ");
  EXPECT_EQ(
      generate(directory, "roadmap --kind warehouse --aisles 4 --slots 6 -o w.roadmap.json").out,
      "wrote w.roadmap.json: 84 vertices, 98 roads, 80 of them one way\n");
  fs::create_directories(directory / "made");
  for (const char* arguments :
       {"--roadmap a.roadmap.json --agents 6 --tasks 12 --durations 0-3 -o made/a.cts.json",
        "--roadmap w.roadmap.json --tasks-on a --agents 12 --tasks 20 -o made/w.cts.json"}) {
    const ProcessResult result = generate(directory, std::string("instance ") + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  for (const char* name : {"a", "w"}) {
    const std::string file = directory / fmt::format("made/{}.cts.json", name);
    const LoadedInstance loaded = read_instance(file);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_TRUE(loaded.instance.roadmap());
    const std::string plan = directory / "plan.json";
    const ProcessResult solved = run_grove({"solve", file, "--omega", "0.1", "--time-limit", "20",
                                            "--require-plan", "--output", plan});
    EXPECT_EQ(solved.exit_code, 0) << solved.err;
    EXPECT_EQ(run_grove({"check", file, plan}).exit_code, 0);
    fs::remove(plan);
  }
}

TEST(GenerateCommand, SameSeedGivesTheSameRoadmap) {
  const TemporaryDirectory directory;
  const std::string start = "roadmap --kind planar --vertices 30 --one-way 20 ";
  for (const char* rest : {"--seed 4 -o 4.json", "--seed 4 -o again.json", "--seed 5 -o 5.json"})
    generate(directory, start + rest);
  EXPECT_EQ(file_content(directory / "4.json"), file_content(directory / "again.json"));
  EXPECT_NE(file_content(directory / "4.json"), file_content(directory / "5.json"));
}

TEST(GenerateCommand, MakesTurningAgentsAndTasksWithDurations) {
  const TemporaryDirectory directory;
  generate(directory, "map rooms --seed 1 -o my.map");
  const std::string start = "instance --map my.map --agents 5 --tasks 10 --seed 1 ";
  generate(directory, start + "-o plain.cts.json");
  generate(directory, start + "--durations 0-0 -o same.cts.json");
  generate(directory,
           start + "--turning --turn-steps 2 --goal-headings --durations 3 -o t.cts.json");
  EXPECT_EQ(file_content(directory / "same.cts.json"), file_content(directory / "plain.cts.json"));
  const Instance instance = read_instance(directory / "t.cts.json").instance;
  for (const Agent& agent : instance.agents()) {
    EXPECT_EQ(agent.motion, Motion{2});
    EXPECT_TRUE(agent.goal_heading);
  }
  for (const Task& task : instance.tasks()) EXPECT_EQ(task.duration, 3);
}

TEST(GenerateCommand, MarksExtrasInTheNamesOfADataset) {
  const TemporaryDirectory directory;
  generate(directory, "map empty -o my.map");
  const std::string start = "dataset --map my.map --agents 5 --tasks 10 --output-dir set ";
  for (const char* rest : {"", "--mg", "--turning", "--turning --mg", "--durations 0-10",
                           "--turning --turn-steps 3 --goal-headings --durations 2-5"})
    EXPECT_EQ(generate(directory, start + rest).exit_code, 0) << rest;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory / "set"))
    names.insert(entry.path().filename());
  EXPECT_EQ(names,
            (std::set<std::string>{
                "manifest.txt", "my_s1_n5_m10.cts.json", "my_s1_n5_m10_mg.cts.json",
                "my_s1_n5_m10_turning.cts.json", "my_s1_n5_m10_turning_mg.cts.json",
                "my_s1_n5_m10_d0-10.cts.json", "my_s1_n5_m10_turning3_headings_d2-5.cts.json"}));
}

TEST(GenerateCommand, MakesInstancesWithChoices) {
  const TemporaryDirectory directory;
  generate(directory, "map empty -o my.map");
  const std::string start = "instance --map my.map --agents 6 --tasks 8 --seed 1 ";
  EXPECT_EQ(generate(directory, start + "--need 1 --any-goal -o any.cts.json").out,
            "wrote any.cts.json: 6 agents, 8 tasks\n");
  const std::string text = file_content(directory / "any.cts.json");
  EXPECT_NE(text.find(R"("agents":"*","need":1)"), std::string::npos) << text;
  const Instance any = read_instance(directory / "any.cts.json").instance;
  for (const Agent& agent : any.agents()) {
    EXPECT_EQ(agent.goals.size(), 6U);
    EXPECT_EQ(agent.options.size(), 8U);
  }
  const std::string half =
      start + "--need 2 --eligible 3 --need-share 0.5 --goal-choices 2 --goal-share 0.5 ";
  generate(directory, half + "-o half.cts.json");
  generate(directory, half + "-o again.cts.json");
  EXPECT_EQ(file_content(directory / "half.cts.json"), file_content(directory / "again.cts.json"));
  const Instance some = read_instance(directory / "half.cts.json").instance;
  EXPECT_EQ(
      std::ranges::count_if(some.agents(), [](const Agent& a) { return a.goals.size() == 2; }), 3);
  EXPECT_EQ(std::ranges::count_if(some.tasks(), [](const Task& t) { return !t.needs_all(); }), 4);
  // The need of all agents is no choice.
  generate(directory, start + "--need 6 --goal-groups 6 -o none.cts.json");
  EXPECT_FALSE(read_instance(directory / "none.cts.json").instance.has_choices());
}

TEST(GenerateCommand, MarksChoicesInTheNamesOfADataset) {
  const TemporaryDirectory directory;
  generate(directory, "map empty -o my.map");
  const std::string start = "dataset --map my.map --agents 5 --tasks 10 --output-dir set ";
  for (const char* rest :
       {"--need 1", "--need 1 --mg", "--need 2 --eligible 3 --need-share 0.5 --any-goal",
        "--goal-choices 2 --durations 0-4", "--goal-groups 2 --goal-share 0.8"})
    EXPECT_EQ(generate(directory, start + rest).exit_code, 0) << rest;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory / "set"))
    names.insert(entry.path().filename());
  EXPECT_EQ(names,
            (std::set<std::string>{"manifest.txt", "my_s1_n5_m10_d0-4_goals2.cts.json",
                                   "my_s1_n5_m10_groups2-80pc.cts.json",
                                   "my_s1_n5_m10_need1.cts.json", "my_s1_n5_m10_need1_mg.cts.json",
                                   "my_s1_n5_m10_need2of3-50pc_anygoal.cts.json"}));
}

TEST(GenerateCommand, RefusesIncompatibleChoices) {
  const TemporaryDirectory directory;
  generate(directory, "map empty -o my.map");
  const auto said = [&](const std::string& arguments) {
    const std::string text = complaint(
        generate(directory, "instance --map my.map --agents 5 --tasks 4 -o x " + arguments));
    return text.substr(0, text.find(" (see "));
  };
  EXPECT_EQ(said("--need 0"), "--need: found '0'; expected an integer from 1 to 100000");
  EXPECT_EQ(said("--need x"), "--need: found 'x'; expected an integer from 1 to 100000");
  EXPECT_EQ(said("--need 6"), "--need: found 6; expected at most 5, the number of agents");
  EXPECT_EQ(said("--eligible 2"), "--eligible: allowed only with --need");
  EXPECT_EQ(said("--need 1 --eligible 6"),
            "--eligible: found 6; expected at most 5, the number of agents");
  EXPECT_EQ(said("--need 3 --eligible 2"),
            "--eligible: found 2; expected at least 3, the value of --need");
  EXPECT_EQ(said("--need-share 0.5"), "--need-share: allowed only with --need");
  EXPECT_EQ(said("--need 1 --need-share 1.5"),
            "--need-share: found '1.5'; expected a number from 0 to 1");
  EXPECT_EQ(said("--need 1 --need-share nan"),
            "--need-share: found 'nan'; expected a number from 0 to 1");
  EXPECT_EQ(said("--any-goal --goal-choices 2"), "--goal-choices: allowed only without --any-goal");
  EXPECT_EQ(said("--any-goal --goal-groups 2"), "--goal-groups: allowed only without --any-goal");
  EXPECT_EQ(said("--goal-choices 2 --goal-groups 2"),
            "--goal-groups: allowed only without --goal-choices");
  EXPECT_EQ(said("--goal-choices 1"),
            "--goal-choices: found '1'; expected an integer from 2 to 100000");
  EXPECT_EQ(said("--goal-choices 6"),
            "--goal-choices: found 6; expected at most 5, the number of agents that choose");
  EXPECT_EQ(said("--goal-groups 4 --goal-share 0.6"),
            "--goal-groups: found 4; expected at most 3, the number of agents that choose");
  EXPECT_EQ(said("--goal-share 0.5"),
            "--goal-share: allowed only with --any-goal, --goal-choices or --goal-groups");
  for (const std::string option : {"--any-goal", "--goal-choices 2", "--goal-groups 2"})
    EXPECT_EQ(said("--mg " + option), option.substr(0, option.find(' ')) +
                                          ": allowed only if all agents have destinations");
  const auto of_set = [&](const std::string& arguments) {
    const std::string text = complaint(generate(directory, arguments + " --output-dir set"));
    return text.substr(0, text.find(" (see "));
  };
  EXPECT_EQ(of_set("paper --any-goal"), "--any-goal: allowed only if all agents have destinations");
  EXPECT_EQ(of_set("paper --agents 20,10 --need 11"),
            "--need: found 11; expected at most 10, the number of agents");
  EXPECT_EQ(of_set("dataset --map my.map --agents 5,10 --tasks 3 --goal-choices 6"),
            "--goal-choices: found 6; expected at most 5, the number of agents that choose");
  EXPECT_EQ(directory.files(), (std::vector<std::string>{"my.map"}));
}

TEST(GeneratePaper, MakesSetsWithChoices) {
  const TemporaryDirectory directory;
  const std::string start = "paper --scenarios 1 --agents 5 --tasks 10 --output-dir paper ";
  EXPECT_EQ(generate(directory, start + "--need 1 --need-share 0.5").out,
            "wrote paper/manifest.txt: 6 instances\n");
  const auto names = lines_of(file_content(directory / "paper/manifest.txt"));
  ASSERT_EQ(names.size(), 6U);
  EXPECT_EQ(names[0], "empty-32x32_s1_n5_m10_need1-50pc.cts.json");
  EXPECT_EQ(names[1], "empty-32x32_s1_n5_m10_need1-50pc_mg.cts.json");
  EXPECT_EQ(lines_of(file_content(directory / "paper/manifest-mg.txt")).size(), 3U);
  EXPECT_EQ(generate(directory, start + "--problem cts --goal-groups 2").out,
            "wrote paper/manifest.txt: 3 instances\n");
  EXPECT_TRUE(fs::exists(directory / "paper/rooms-32x32_s1_n5_m10_groups2.cts.json"));
}

TEST(GenerateCommand, RefusesIncompatibleOptions) {
  const TemporaryDirectory directory;
  generate(directory, "map empty -o my.map");
  generate(directory, "roadmap --kind warehouse -o w.json");
  const auto said = [&](const std::string& arguments) {
    const std::string text = complaint(generate(directory, arguments + " -o x"));
    return text.substr(0, text.find(" (see "));
  };
  EXPECT_EQ(said("roadmap"), "--kind is required");
  EXPECT_EQ(said("roadmap --kind x"), "--kind: found 'x'; expected one of planar, warehouse");
  EXPECT_EQ(said("roadmap --kind warehouse --seed 1"), "--seed: allowed only with --kind planar");
  EXPECT_EQ(said("roadmap --kind planar --bays 1"), "--bays: allowed only with --kind warehouse");
  EXPECT_EQ(said("roadmap --kind planar --one-way 101"),
            "--one-way: found '101'; expected an integer from 0 to 100");
  EXPECT_TRUE(said("roadmap --kind planar --vertices 9000")
                  .starts_with("roadmap: 9000 vertices do not fit into 50 x 50 m"));
  EXPECT_TRUE(
      said("roadmap --kind warehouse --aisles 5").starts_with("roadmap: found 5 aisles; expected"));
  EXPECT_EQ(said("roadmap --kind warehouse --metres-per-step 0"),
            "--metres-per-step: found '0'; expected a number from 0.01 to 1000");
  const std::string sizes = "instance --agents 5 --tasks 5 ";
  EXPECT_EQ(said(sizes), "--map or --roadmap is required");
  EXPECT_EQ(said(sizes + "--map my.map --roadmap w.json"), "--map: allowed only without --roadmap");
  EXPECT_EQ(said(sizes + "--scen s --roadmap w.json"), "--scen: allowed only with --map");
  EXPECT_EQ(said(sizes + "--turning --roadmap w.json"),
            "--turning: allowed only with --map, because only agents on grids have headings");
  EXPECT_EQ(said(sizes + "--map my.map --tasks-on a"), "--tasks-on: allowed only with --roadmap");
  EXPECT_EQ(said(sizes + "--map my.map --turn-steps 2"),
            "--turn-steps: allowed only with --turning");
  EXPECT_EQ(said(sizes + "--map my.map --goal-headings"),
            "--goal-headings: allowed only with --turning");
  EXPECT_EQ(said(sizes + "--map my.map --turning --goal-headings --mg"),
            "--goal-headings: allowed only if some agents have destinations");
  EXPECT_EQ(said(sizes + "--map my.map --durations 3-1"),
            "--durations: found '3-1'; expected the smaller number first");
  EXPECT_EQ(said(sizes + "--map my.map --durations 3-"),
            "--durations: found ''; expected an integer from 0 to 65536");
  EXPECT_TRUE(said("instance --agents 5 --tasks 500 --roadmap w.json")
                  .starts_with("w.json: 500 tasks for 5 agents do not fit: "));
  EXPECT_EQ(complaint(generate(directory, sizes + "--roadmap w.json -o w.json")),
            "w.json: is the roadmap; expected another file to write to");
  EXPECT_EQ(directory.files(), (std::vector<std::string>{"my.map", "w.json"}));
}

TEST(GenerateCommand, HasHelpThatFitsATerminal) {
  for (const char* part : {"map", "roadmap", "scenario", "instance", "dataset", "paper"}) {
    const ProcessResult help = run_grove({"generate", part, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const std::string& line : lines_of(help.out)) EXPECT_LE(line.size(), 100U) << line;
  }
}

TEST(GeneratePaper, MakesTheSameSetForRobotsThatTurn) {
  const TemporaryDirectory directory;
  const std::string start = "paper --scenarios 1 --agents 5 --tasks 10 --output-dir paper ";
  ASSERT_EQ(generate(directory, start).exit_code, 0);
  const ProcessResult result = generate(directory, start + "--turning --durations 0-10");
  EXPECT_EQ(result.out, "wrote paper/manifest.txt: 6 instances\n") << result.err;
  const auto names = lines_of(file_content(directory / "paper/manifest.txt"));
  ASSERT_EQ(names.size(), 6U);
  EXPECT_EQ(names[0], "empty-32x32_s1_n5_m10_turning_d0-10.cts.json");
  EXPECT_EQ(names[1], "empty-32x32_s1_n5_m10_turning_d0-10_mg.cts.json");
  EXPECT_EQ(lines_of(file_content(directory / "paper/manifest-mg.txt")).size(), 3U);
  const Instance turning = read_instance(directory.path() / "paper" / names[0]).instance;
  const Instance plain = read_instance(directory / "paper/empty-32x32_s1_n5_m10.cts.json").instance;
  EXPECT_EQ(turning.agent(0).motion, Motion{1});
  EXPECT_EQ(turning.pose_of(turning.agent(0).start).place, plain.agent(0).start);
  EXPECT_EQ(turning.agent(0).tasks, plain.agent(0).tasks);
  EXPECT_EQ(turning.task(3).cell, plain.task(3).cell);
}

TEST(GeneratePaper, MakesOneSetOfThreeMapsAndTwoProblems) {
  const TemporaryDirectory directory;
  const ProcessResult result = generate(
      directory, "paper --scenarios 1-2,4 --agents 5,10 --tasks 10,30 --output-dir out/paper");
  EXPECT_EQ(result.out, "wrote out/paper/manifest.txt: 72 instances\n") << result.err;
  const auto names = lines_of(file_content(directory / "out/paper/manifest.txt"));
  ASSERT_EQ(names.size(), 72U);
  EXPECT_EQ(std::set(names.begin(), names.end()).size(), 72U);
  EXPECT_EQ(names[0], "empty-32x32_s1_n5_m10.cts.json");
  EXPECT_EQ(names[1], "empty-32x32_s1_n5_m10_mg.cts.json");
  EXPECT_EQ(names[71], "rooms-32x32_s4_n10_m30_mg.cts.json");
  for (const std::string& name : names) {
    const Instance instance = read_instance(directory.path() / "out/paper" / name).instance;
    EXPECT_EQ(instance.agent(0).goal.has_value(), !name.ends_with("_mg.cts.json"));
  }
  EXPECT_EQ(lines_of(file_content(directory / "out/paper/manifest-cts.txt")).size(), 36U);
  const auto mg = lines_of(file_content(directory / "out/paper/manifest-mg.txt"));
  EXPECT_EQ(mg.size(), 36U);
  for (const std::string& name : mg) EXPECT_TRUE(name.ends_with("_mg.cts.json")) << name;
  // The maps and instances equal the data shipped with Grove.
  const fs::path data = GROVE_DATA;
  for (const char* map : {"empty-32x32.map", "random-32x32-20.map", "rooms-32x32.map"})
    EXPECT_EQ(file_content(directory.path() / "out/paper" / map), file_content(data / map)) << map;
  for (const char* map : {"empty-32x32", "rooms-32x32"})
    EXPECT_EQ(
        file_content(directory.path() / "out/paper" / (map + std::string("_s1_n5_m10.cts.json"))),
        file_content(data / (map + std::string("_n5_m10.cts.json"))));
}

TEST(GeneratePaper, TakesScenariosOfBothKindsFromMovingAi) {
  const TemporaryDirectory directory;
  fs::create_directories(directory / "ai");
  generate(directory, "map empty -o ai/m-1.map");
  generate(directory, "scenario --map ai/m-1.map --rows 40 --seed 1 -o ai/m-1-random-3.scen");
  generate(directory, "scenario --map ai/m-1.map --rows 40 --seed 2 -o ai/m-1-even-2.scen");
  const std::string start = "paper --movingai ai --maps m-1 --agents 5 --tasks 10 --seed 2 ";
  ASSERT_EQ(generate(directory, start + "--scenarios 3,27 --problem cts --output-dir out").out,
            "wrote out/manifest.txt: 2 instances\n");
  for (const char* one : {"random-3.scen --seed 5 -o s3", "even-2.scen --seed 29 -o s27"}) {
    const std::string made = std::string(one).substr(std::string(one).rfind(' ') + 1);
    generate(directory,
             "instance --map ai/m-1.map --agents 5 --tasks 10 --scen ai/m-1-" + std::string(one));
    const std::string text = file_content(directory / ("out/m-1_" + made + "_n5_m10.cts.json"));
    const std::string map = "\"../ai/m-1.map\"";
    ASSERT_NE(text.find(map), std::string::npos);
    EXPECT_EQ(std::string(text).replace(text.find(map), map.size(), "\"ai/m-1.map\""),
              file_content(directory / made));
  }
  const auto said = [&](const std::string& more) {
    return complaint(generate(directory, start + more + " --output-dir no"));
  };
  EXPECT_EQ(said("--scenarios 3-4"),
            "ai/m-1-random-4.scen: does not exist; expected it, or --scenarios 3");
  EXPECT_EQ(said("--scenarios 26"), "ai/m-1-even-1.scen: does not exist; expected it");
  generate(directory, "scenario --map ai/m-1.map --rows 40 --seed 3 -o ai/m-1-random-2.scen");
  EXPECT_EQ(said("--scenarios 1-27"),
            "ai/m-1-random-1.scen: does not exist; expected it, or --scenarios 2-3,27");
  EXPECT_TRUE(said("--scenarios 51").starts_with("--scenarios: found more than 50"));
  EXPECT_TRUE(said("--maps m-1").starts_with("--maps: found 'm-1' more than once"));
  EXPECT_FALSE(fs::exists(directory / "no"));
}

TEST(GeneratePaper, RefusesInvalidOptions) {
  const TemporaryDirectory directory;
  const auto said = [&](const std::string& more) {
    return complaint(generate(directory, "paper --output-dir out " + more));
  };
  const std::string hint = " (see 'grove generate paper --help')";
  EXPECT_EQ(said("--maps a"), "--maps: allowed only with --movingai" + hint);
  EXPECT_EQ(said("--problem x"), "--problem: found 'x'; expected one of both, cts, mg" + hint);
  EXPECT_EQ(said("--scenarios 3-1"),
            "--scenarios: found '3-1'; expected the smaller number first" + hint);
  EXPECT_EQ(said("--scenarios 1-3,2"),
            "--scenarios: found '1-3,2'; expected distinct integers" + hint);
  EXPECT_EQ(said("--scenarios 0-3"),
            "--scenarios: found '0'; expected an integer from 1 to 10000" + hint);
  EXPECT_EQ(said("--scenarios 1-"),
            "--scenarios: found ''; expected an integer from 1 to 10000" + hint);
  EXPECT_FALSE(fs::exists(directory / "out"));
}

TEST(GenerateCommand, RefusesTooLargeCountsAndWritesNothing) {
  const TemporaryDirectory directory;
  generate(directory, "map empty --width 10 --height 10 -o my.map");
  generate(directory, "scenario --map my.map --rows 40 -o my.scen");
  const auto said = [&](const std::string& arguments) {
    return complaint(generate(directory, arguments));
  };
  EXPECT_EQ(
      said("scenario --map my.map --rows 101 -o x"),
      "my.map: has 100 connected passable cells; expected at least 101 for 101 scenario rows");
  EXPECT_EQ(said("instance --map my.map --scen my.scen --agents 5 --tasks 21 -o x"),
            "my.scen: has 40 rows, enough for 20 of 21 tasks; they are taken from row 21 on");
  EXPECT_EQ(
      said("instance --map my.map --agents 50 --tasks 51 -o x"),
      "my.map: has 100 connected passable cells; expected at least 101 for 50 agents and 51 tasks");
  EXPECT_EQ(said("instance --map my.map --agents 1 --tasks 70 -o x"),
            "my.map: 70 tasks for 1 agents do not fit: agent 'a0' must visit more than 64 tasks; "
            "expected "
            "at most 64");
  EXPECT_EQ(said("dataset --map my.map --scen my.scen --agents 5 --tasks 10,30 --output-dir set")
                .substr(0, 21),
            "my.scen: has 40 rows,");
  EXPECT_EQ(directory.files(), (std::vector<std::string>{"my.map", "my.scen"}));
}

TEST(GenerateCommand, RefusesAScenarioForAnotherMap) {
  const TemporaryDirectory directory;
  generate(directory, "map empty -o a.map");
  generate(directory, "map empty -o b.map");
  generate(directory, "scenario --map a.map --rows 30 -o a.scen");
  EXPECT_EQ(complaint(generate(directory,
                               "instance --map b.map --scen a.scen --agents 1 --tasks 1 -o x")),
            "a.scen: line 2: the row is for map 'a.map'; expected 'b.map'");
}

TEST(GenerateCommand, RefusesUnwritableOutputs) {
  const TemporaryDirectory directory;
  EXPECT_EQ(complaint(generate(directory, "map empty -o none/my.map")),
            "none/my.map: cannot be written: No such file or directory");
  EXPECT_EQ(complaint(generate(directory, "map empty -o .")),
            ".: is a directory; expected a file name");
  EXPECT_EQ(complaint(generate(directory, "map empty -o /dev/full")),
            "/dev/full: cannot be written: No space left on device");
  directory.write("file", "");
  generate(directory, "map empty -o my.map");
  EXPECT_TRUE(
      complaint(generate(directory, "dataset --map my.map --agents 1 --tasks 1 --output-dir file"))
          .starts_with("file: "));
}

}  // namespace generate_command_test
}  // namespace grove::detail
