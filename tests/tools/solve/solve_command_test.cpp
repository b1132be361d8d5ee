// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "io/file_lock.h"
#include "model/omega.h"
#include "sequencing/rtsp.h"
#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace solve_command_test {

using nlohmann::json;
using ::testing::AnyOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string data(const std::string& name) {
  return std::string(GROVE_DATA) + "/" + name;
}

// Each agent can finish if it is alone. Both cannot: each must rest on its task, and they cannot
// pass each other. Only a search over joint states proves this, so without it a run ends only at a
// limit.
constexpr const char* kPuzzleMap = "type octile\nheight 1\nwidth 5\nmap\n.....\n";
constexpr const char* kPuzzle = R"({"map": "puzzle.map",
  "agents": [{"id": "a", "start": [0, 0]}, {"id": "b", "start": [4, 0]}],
  "tasks": [{"id": "t", "cell": [3, 0], "agents": ["a"]}, {"id": "u", "cell": [1, 0], "agents": ["b"]}]})";

class SolveCommand : public ::testing::Test {
 protected:
  SolveCommand() {
    directory_.write("puzzle.map", kPuzzleMap);
    directory_.write("puzzle.json", kPuzzle);
    options_.directory = directory_.path().string();
  }

  ProcessResult solve(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "solve");
    return run_grove(arguments, options_);
  }
  // Runs a bash command, in which $0 is the program and $1 the instance.
  ProcessResult in_shell(const std::string& instance, const std::string& command) const {
    return run_program({"/bin/bash", "-c", command, GROVE_PROGRAM, data(instance)}, options_);
  }
  json plan(const std::string& name) const {
    std::ifstream file(directory_ / name);
    return json::parse(file);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(directory_ / name); }
  // Returns whether a log file exists and contains this text.
  bool log_contains(const std::string& log, const std::string& text) const {
    return exists(log) && file_content(directory_ / log).find(text) != std::string::npos;
  }

  TemporaryDirectory directory_;
  ProcessOptions options_;
};

TEST_F(SolveCommand, WritesAPlanThatTheCheckerAccepts) {
  for (const char* name : {"first", "empty-32x32_n5_m10", "random-32x32-20_n5_m10_mg"}) {
    const std::string instance = data(std::string(name) + ".cts.json");
    const ProcessResult solved = solve({instance, "--omega", "0"});
    ASSERT_EQ(solved.exit_code, 0) << solved.err;
    const std::string file = std::string(name) + ".plan.json";
    EXPECT_EQ(plan(file)["status"], "optimal");
    EXPECT_EQ(plan(file)["cost"], plan(file)["lower_bound"]);
    const ProcessResult checked = run_grove({"check", instance, directory_ / file});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
  }
}

TEST_F(SolveCommand, ReplacesAForeignFileOnlyByName) {
  directory_.write("first.plan.json", "{\"notes\": 1}\n");
  EXPECT_EQ(complaint(solve({data("first.cts.json")})),
            "first.plan.json: exists and is not a plan file; expected '-o first.plan.json' to "
            "replace it, or another name");
  EXPECT_EQ(plan("first.plan.json")["notes"], 1);
  EXPECT_EQ(solve({data("first.cts.json"), "-o", "first.plan.json"}).exit_code, 0);
  EXPECT_EQ(solve({data("first.cts.json")}).exit_code, 0) << "the plan of an earlier run";
  EXPECT_EQ(plan("first.plan.json")["status"], "optimal");
}

TEST_F(SolveCommand, SolvesTheFirstRowsOfAScenario) {
  const ProcessResult solved = solve({data("empty-32x32.scen"), "--map", data("empty-32x32.map"),
                                      "--agents", "10", "--output", "p.json"});
  ASSERT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_EQ(plan("p.json")["agents"].size(), 10u);
}

TEST_F(SolveCommand, FindsTheMapNextToAScenario) {
  const ProcessResult solved = solve({data("empty-32x32.scen"), "--agents", "3"});
  EXPECT_THAT(solved.out, HasSubstr("empty-32x32.map: 32 x 32"));
  std::filesystem::copy(data("empty-32x32.scen"), directory_.path());
  EXPECT_THAT(complaint(solve({"empty-32x32.scen", "--agents", "3"})),
              HasSubstr("is not beside the map that it names"));
}

TEST_F(SolveCommand, ReadsAnInstanceFromStandardInput) {
  options_.input = kPuzzle;
  const ProcessResult solved = solve({"-", "--time-limit", "0"});
  EXPECT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_THAT(solved.out, HasSubstr("standard input: 2 agents"));
  EXPECT_EQ(plan("stdin.plan.json")["stats"]["instance"], "standard input");
  options_.input = "{";
  EXPECT_THAT(complaint(solve({"-"})), HasSubstr("standard input: line 1, column 2"));
}

TEST_F(SolveCommand, UsesTheLastOfARepeatedOption) {
  const ProcessResult solved =
      solve({data("first.cts.json"), "--omega", "inf", "--output", "nowhere/p", "--without",
             "primal", "--output", "p.json", "--without", "bypass,target", "--omega", "0"});
  EXPECT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_EQ(plan("p.json")["stats"]["options"],
            "--omega 0 --without primal,bypass,target --output p.json");
}

TEST_F(SolveCommand, AcceptsOldNamesOfTechniques) {
  const auto nodes = [&](const std::string& techniques) {
    const ProcessResult solved =
        solve({data("rooms-32x32_n10_m30.cts.json"), "--omega", "0", "--threads", "1",
               "--deterministic", "--without", techniques, "--output", "p.json"});
    EXPECT_EQ(solved.exit_code, 0) << solved.err;
    return plan("p.json")["stats"]["nodes_expanded"].get<int>();
  };
  EXPECT_EQ(nodes("configurations,traversal,dependencies,joint-paths,priced-plans"),
            nodes("lacam,corridor,wdg,joint-mdd,lagrangian-lns"));
  EXPECT_THAT(solve({"--help"}).out, Not(HasSubstr("priced-plans")));
}

TEST_F(SolveCommand, SetsTunables) {
  const auto nodes = [&](std::vector<std::string> tune) {
    std::vector<std::string> arguments = {data("rooms-32x32_n10_m30.cts.json"),
                                          "--omega",
                                          "0",
                                          "--threads",
                                          "1",
                                          "--output",
                                          "p.json"};
    arguments.insert(arguments.end(), tune.begin(), tune.end());
    const ProcessResult solved = solve(arguments);
    EXPECT_EQ(solved.exit_code, 0) << solved.err;
    EXPECT_EQ(plan("p.json")["cost"], 1070);
    return plan("p.json")["stats"]["pair_expansions"].get<int>();
  };
  const int defaults = nodes({});
  EXPECT_EQ(nodes({"--tune", "pair-expansions=16"}), defaults);
  EXPECT_LT(nodes({"--tune", "pair-expansions=1,large-gap=0", "--tune", "bound-work=3000"}),
            defaults);
  EXPECT_THAT(plan("p.json")["stats"]["options"].get<std::string>(),
              HasSubstr("--tune pair-expansions=1,large-gap=0,bound-work=3000"));
  EXPECT_EQ(
      complaint(solve({data("first.cts.json"), "--tune", "mdd-node=3"})),
      "--tune: found 'mdd-node'; expected one of those that '--tune help' lists; did you mean "
      "'mdd-nodes'? (see 'grove solve --help')");
  EXPECT_THAT(complaint(solve({data("first.cts.json"), "--tune", "mdd-nodes=0"})),
              HasSubstr("--tune: mdd-nodes: found '0'; expected an integer from 1 to 1000000000"));
  EXPECT_THAT(complaint(solve({data("first.cts.json"), "--tune", "mdd-nodes"})),
              HasSubstr("expected NAME=VALUE"));
  EXPECT_EQ(nodes({"--tune", "compared-pairs=50000,spot-steps=8"}), defaults) << "old names";
  const ProcessResult help = solve({"--tune", "help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("\npair-expansions=16  (from 1 to 1000000)\n"));
  EXPECT_THAT(solve({"--help"}).out, Not(HasSubstr("--tune")));
}

TEST_F(SolveCommand, RefusesRemovedTechniques) {
  for (const char* option : {"--with", "--without"})
    EXPECT_THAT(complaint(solve({data("first.cts.json"), option, "sequence-splits"})),
                StartsWith(std::string(option) +
                           ": the technique 'sequence-splits' was removed from Grove; expected "));
  EXPECT_THAT(complaint(solve({data("first.cts.json"), "--with", "primal"})),
              HasSubstr("every technique is on by default"));
  EXPECT_THAT(solve({"--help"}).out, Not(HasSubstr("--with ")));
}

TEST_F(SolveCommand, LogsHeadTableAndSummary) {
  const ProcessResult solved = solve({data("first.cts.json"), "--log", "run.log", "--seed", "4"});
  EXPECT_EQ(solved.err, "");
  for (const char* part :
       {"grove 0.", "2 agents, 3 tasks", "9 x 5, 41 passable cells", "--seed 4",
        "gap = (incumbent - lower bound) / lower bound", "lower bound     incumbent",
        "Status        optimal", "Cost          33", "Plan file     first.plan.json"})
    EXPECT_THAT(solved.out, HasSubstr(part));
  std::ifstream file(directory_ / "run.log");
  std::stringstream log;
  log << file.rdbuf();
  EXPECT_EQ(log.str(), solved.out);
}

TEST_F(SolveCommand, QuietPrintsNothing) {
  const ProcessResult solved = solve({data("first.cts.json"), "--quiet"});
  EXPECT_EQ(solved.out + solved.err, "");
  EXPECT_TRUE(exists("first.plan.json"));
}

TEST_F(SolveCommand, EveryBackendFindsTheSameOptimum) {
  for (const char* backend : {"auto", "dp", "cbc"}) {
    if (backend == std::string("cbc") && !is_built(RtspBackend::kCbc)) continue;
    solve({data("first.cts.json"), "--omega", "0", "--policy", "fixed", "--rtsp", backend,
           "--output", "p.json"});
    EXPECT_EQ(plan("p.json")["cost"], 33) << backend;
  }
}

TEST_F(SolveCommand, EveryPolicyFindsTheSameOptimum) {
  for (const char* policy : {"auto", "fixed", "free"})
    for (const char* name : {"first.cts.json", "random-32x32-20_n5_m10_mg.cts.json"}) {
      solve(
          {data(name), "--omega", "0", "--policy", policy, "--output", std::string(policy) + name});
      EXPECT_EQ(plan(std::string(policy) + name)["status"], "optimal");
      EXPECT_EQ(plan(std::string(policy) + name)["cost"], plan(std::string("auto") + name)["cost"]);
    }
}

TEST_F(SolveCommand, EndsAtTheTimeLimitWithABound) {
  const ProcessResult solved = solve(
      {"puzzle.json", "--without", "joint-search", "--time-limit", "0.3", "--output", "p.json"});
  EXPECT_EQ(solved.exit_code, 0);
  EXPECT_THAT(solved.out, HasSubstr("unknown (stopped by: time limit)"));
  const json result = plan("p.json");
  EXPECT_EQ(result["status"], "unknown");
  EXPECT_FALSE(result.contains("cost"));
  EXPECT_FALSE(result.contains("agents"));
  EXPECT_GT(result["lower_bound"], 0);
  EXPECT_EQ(result["stats"]["stopped_by"], "time limit");
}

TEST_F(SolveCommand, ProvesThatAPuzzleHasNoPlan) {
  const ProcessResult solved = solve({"puzzle.json", "--output", "p.json"});
  EXPECT_THAT(solved.out, HasSubstr("Status        infeasible"));
  EXPECT_THAT(solved.out, Not(HasSubstr("1152921504606846976")));
  EXPECT_EQ(plan("p.json")["status"], "infeasible");
  EXPECT_EQ(plan("p.json")["lower_bound"], 0);
}

// The tree for the puzzle would exceed this limit within a second.
TEST_F(SolveCommand, ContinuesAtTheMemoryLimit) {
  const ProcessResult solved = solve({"puzzle.json", "--policy", "fixed", "--memory-limit", "0.03",
                                      "--time-limit", "4", "--output", "p.json"});
  EXPECT_EQ(solved.exit_code, 0) << solved.err;
  const json stats = plan("p.json")["stats"];
  EXPECT_EQ(stats["stopped_by"], "time limit");
  EXPECT_GT(stats["nodes_evicted"], 0);
  EXPECT_LT(stats["node_bytes"], 200);
  EXPECT_LT(stats["peak_memory_mb"], 35);
  EXPECT_THAT(solved.out, HasSubstr("bytes per node"));
}

TEST_F(SolveCommand, EndsIfTheMemoryLimitCannotBeKept) {
  const ProcessResult solved =
      solve({"puzzle.json", "--memory-limit", "0.001", "--time-limit", "30", "--output", "p.json"});
  EXPECT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_EQ(plan("p.json")["stats"]["stopped_by"], "memory limit");
}

TEST_F(SolveCommand, SignalsEndARunCleanly) {
  for (const int signal : {SIGINT, SIGTERM}) {
    options_.signal = signal;
    options_.signal_when = [this] { return log_contains("run.log", "\nB "); };
    const ProcessResult solved = solve(
        {"puzzle.json", "--without", "joint-search", "--log", "run.log", "--output", "p.json"});
    EXPECT_EQ(solved.exit_code, 0) << solved.err;
    EXPECT_FALSE(solved.timed_out);
    EXPECT_EQ(plan("p.json")["stats"]["stopped_by"], "interrupt");
    EXPECT_GT(plan("p.json")["lower_bound"], 0);
    std::filesystem::remove(directory_ / "p.json");
    std::filesystem::remove(directory_ / "run.log");
  }
}

TEST_F(SolveCommand, ReportsWhyThereIsNoPlan) {
  directory_.write("wall.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n");
  directory_.write(
      "wall.json",
      R"({"map": "wall.map", "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}], "tasks": []})");
  const ProcessResult solved = solve({"wall.json", "--output", "p.json"});
  EXPECT_EQ(solved.exit_code, 0);
  EXPECT_THAT(solved.out, HasSubstr("agent 'a' cannot reach [2, 0]"));
  EXPECT_EQ(plan("p.json")["status"], "infeasible");
}

TEST_F(SolveCommand, ReportsInfiniteOmega) {
  solve({data("first.cts.json"), "--omega", "inf", "--output", "p.json"});
  EXPECT_EQ(plan("p.json")["omega"], "inf");
  EXPECT_EQ(plan("p.json")["stats"]["roots_generated"], 1);
}

// Returns the log without times, memory, options and number of threads.
std::string timeless(const std::string& log) {
  return std::regex_replace(
      log, std::regex(R"( +[0-9]+ MB +[0-9.]+s|[0-9.]+ s\n|Memory .*\n|Options .*\n|Threads .*\n)"),
      "");
}

TEST_F(SolveCommand, DeterministicRunIsTheSameForAnyThreads) {
  for (const std::string policy : {"fixed", "free"}) {
    std::vector<std::string> logs;
    std::vector<json> agents;
    for (const std::string threads : {"1", "2", "4"}) {
      logs.push_back(
          timeless(solve({data("random-32x32-20_n10_m30.cts.json"), "--omega", "0", "--policy",
                          policy, "--deterministic", "--threads", threads, "--output", "p.json"})
                       .out));
      agents.push_back(plan("p.json")["agents"]);
    }
    EXPECT_EQ(logs[1], logs[0]);
    EXPECT_EQ(logs[2], logs[0]);
    EXPECT_GT(std::ranges::count(logs[0], '\n'), 15);
    EXPECT_EQ(agents[1], agents[0]);
    EXPECT_EQ(agents[2], agents[0]);
  }
}

TEST_F(SolveCommand, RefusesUnwritableFilesBeforeTheSearch) {
  EXPECT_THAT(complaint(solve({"puzzle.json", "--output", "nowhere/p.json"})),
              HasSubstr("nowhere"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--output", directory_.path().string()})),
              HasSubstr("directory"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--log", "nowhere/run.log"})), HasSubstr("nowhere"));
  EXPECT_FALSE(exists("puzzle.plan.json"));
}

TEST_F(SolveCommand, DoesNotOverwriteItsInputs) {
  for (const char* name : {"first.map", "first.cts.json"})
    std::filesystem::copy(data(name), directory_.path());
  EXPECT_THAT(complaint(solve({"first.cts.json", "--output", "first.cts.json"})),
              HasSubstr("is the instance"));
  EXPECT_THAT(complaint(solve({"first.cts.json", "--output", "./first.map"})),
              HasSubstr("is the map"));
  EXPECT_THAT(complaint(solve({"first.cts.json", "--log", "first.map"})), HasSubstr("is the map"));
  EXPECT_THAT(complaint(solve({"first.cts.json", "--output", "x", "--log", "./x"})),
              HasSubstr("is the plan file"));
  EXPECT_EQ(solve({"first.cts.json"}).exit_code, 0);
}

TEST_F(SolveCommand, WritesThePlanIfTheLogPipeIsClosed) {
  const ProcessResult solved = in_shell(
      "rooms-32x32_n10_m30.cts.json",
      R"("$0" solve "$1" --omega 0 --policy fixed --output p.json | true; exit ${PIPESTATUS[0]})");
  EXPECT_EQ(solved.exit_code, 0);
  EXPECT_THAT(solved.err, HasSubstr("warning: standard output cannot be written"));
  EXPECT_EQ(plan("p.json")["status"], "optimal");
}

TEST_F(SolveCommand, WritesThePlanIfAllOutputFails) {
  const char* command = R"("$0" solve "$1" --output p.json >/dev/full 2>/dev/full)";
  EXPECT_EQ(in_shell("first.cts.json", command).exit_code, 0);
  EXPECT_EQ(plan("p.json")["status"], "optimal");
}

TEST_F(SolveCommand, WarnsIfTheLogFileCannotBeWritten) {
  const ProcessResult solved = solve({data("first.cts.json"), "--quiet", "--log", "/dev/full"});
  EXPECT_EQ(solved.exit_code, 0);
  EXPECT_THAT(solved.err, HasSubstr("warning: the log file cannot be written"));
}

TEST_F(SolveCommand, NamesAScenariosPlanAfterItsAgents) {
  solve({data("empty-32x32.scen"), "--map", data("empty-32x32.map"), "--agents", "3"});
  EXPECT_TRUE(exists("empty-32x32-3.plan.json"));
}

// A table indexed by time and cell would take gigabytes on this map.
TEST_F(SolveCommand, KeepsTheMemoryLimitOnALargeMap) {
  ASSERT_EQ(run_grove({"generate", "map", "empty", "--width", "600", "--height", "600", "-o",
                       directory_ / "m.map"})
                .exit_code,
            0);
  ASSERT_EQ(run_grove({"generate", "instance", "--map", directory_ / "m.map", "--agents", "5",
                       "--tasks", "10", "-o", directory_ / "m.cts.json"})
                .exit_code,
            0);
  const ProcessResult solved =
      solve({"m.cts.json", "--memory-limit", "0.25", "--threads", "1", "--output", "p.json"});
  EXPECT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_EQ(plan("p.json")["status"], "optimal");
  EXPECT_LT(plan("p.json")["stats"]["peak_memory_mb"], 250);
}

TEST_F(SolveCommand, RefusesInvalidArguments) {
  EXPECT_THAT(complaint(solve({"puzzle.json", "--omega", "-1"})), HasSubstr("--omega"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--omega", "1%"})), HasSubstr("--omega"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--time-limit", "soon"})), HasSubstr("--time-limit"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--memory-limit", "-1"})),
              HasSubstr("--memory-limit"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--threads", "0"})), HasSubstr("--threads"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--policy", "best"})),
              HasSubstr("auto, fixed, free"));
  EXPECT_THAT(complaint(solve({"other.yaml"})), HasSubstr("'grove convert' makes from it"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--rtsp", "gurobi"})), HasSubstr("auto, cbc, dp"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--rtsp", "cbc"})),
              is_built(RtspBackend::kCbc)
                  ? HasSubstr("requires --policy fixed; expected that, or no --rtsp cbc")
                  : HasSubstr("built without CBC"));
  EXPECT_THAT(complaint(solve({"puzzle.json", "--omgea", "0"})), HasSubstr("--omgea"));
  EXPECT_THAT(complaint(solve({"missing.json"})), HasSubstr("missing.json"));
  for (const char* file : {"first.map", "plant.roadmap.json", "plant.graphml", "plant.lif.json"})
    EXPECT_THAT(complaint(solve({data(file)})), HasSubstr("expected an instance"));
  EXPECT_THAT(complaint(solve({data("empty-32x32.scen")})), HasSubstr("--agents"));
  EXPECT_THAT(complaint(solve(
                  {data("empty-32x32.scen"), "--map", data("empty-32x32.map"), "--agents", "900"})),
              HasSubstr("900"));
}

// --- plan files of earlier runs ---

TEST_F(SolveCommand, WithoutAPlanKeepsAValidOne) {
  solve({data("first.cts.json"), "--output", "p.json"});
  const std::string before = file_content(directory_ / "p.json");
  for (const bool quiet : {false, true}) {
    std::vector<std::string> words{data("first.cts.json"), "--output", "p.json", "--time-limit",
                                   "0"};
    if (quiet) words.push_back("--quiet");
    const ProcessResult solved = solve(words);
    EXPECT_EQ(solved.exit_code, 0);
    EXPECT_THAT(solved.err, StartsWith("grove: no plan was found (unknown, stopped by: time limit, "
                                       "lower bound "));
    EXPECT_THAT(solved.err, EndsWith("; p.json keeps its valid plan of cost 33\n"));
    EXPECT_EQ(solved.out.find("p.json (kept as it is, with a valid plan of cost 33)") ==
                  std::string::npos,
              quiet);
    EXPECT_EQ(file_content(directory_ / "p.json"), before);
  }
}

TEST_F(SolveCommand, WithoutAPlanReplacesInvalidAndForeignPlans) {
  solve({data("first.cts.json"), "--output", "p.json"});
  json changed = plan("p.json");
  changed["agents"][0]["path"].erase(0);
  directory_.write("p.json", changed.dump());
  const ProcessResult solved =
      solve({data("first.cts.json"), "--output", "p.json", "--time-limit", "0", "--quiet"});
  EXPECT_THAT(solved.err, StartsWith("grove: no plan was found (unknown, "));
  EXPECT_THAT(solved.err, Not(HasSubstr("keeps")));
  EXPECT_EQ(plan("p.json")["status"], "unknown");
  solve({data("rooms-32x32_n5_m10.cts.json"), "--output", "p.json", "--quiet"});
  solve({data("first.cts.json"), "--output", "p.json", "--time-limit", "0", "--quiet"});
  EXPECT_EQ(plan("p.json")["status"], "unknown");
}

TEST_F(SolveCommand, ReturnsThreeIfARequiredPlanIsMissing) {
  EXPECT_EQ(solve({data("first.cts.json"), "--require-plan"}).exit_code, 0);
  EXPECT_EQ(solve({data("first.cts.json"), "--require-plan", "--time-limit", "0"}).exit_code, 3);
  EXPECT_EQ(plan("first.plan.json")["cost"], 33);
}

TEST_F(SolveCommand, WritesThePlanToStandardOutput) {
  const ProcessResult solved = solve({data("first.cts.json"), "--output", "-"});
  EXPECT_EQ(json::parse(solved.out)["cost"], 33);
  EXPECT_THAT(solved.err, HasSubstr("Plan file     standard output"));
  EXPECT_EQ(directory_.files(), (std::vector<std::string>{"puzzle.json", "puzzle.map"}));
  EXPECT_EQ(solve({data("first.cts.json"), "-o", "-", "--quiet"}).err, "");
  const char* command = R"("$0" solve "$1" -o - --quiet >/dev/full)";
  EXPECT_EQ(in_shell("first.cts.json", command).exit_code, 1);
}

// --- JSON log ---

std::vector<json> events(const std::string& log) {
  std::vector<json> found;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) found.push_back(json::parse(line));
  return found;
}

TEST_F(SolveCommand, WritesAJsonLog) {
  const ProcessResult solved =
      solve({data("rooms-32x32_n10_m30.cts.json"), "--omega", "0", "--threads", "1", "--log-format",
             "jsonl", "--log", "log.jsonl", "--output", "p.json"});
  EXPECT_EQ(solved.err, "");
  EXPECT_EQ(file_content(directory_ / "log.jsonl"), solved.out);
  const std::vector<json> log = events(solved.out);
  ASSERT_GT(log.size(), 2u);
  EXPECT_EQ(log.front()["event"], "header");
  EXPECT_EQ(log.front()["agents"], 10);
  EXPECT_THAT(std::string(log.front()["options"]), HasSubstr("--omega 0 --threads 1"));
  EXPECT_EQ(log.back()["event"], "summary");
  EXPECT_EQ(log.back()["status"], "optimal");
  EXPECT_EQ(log.back()["stats"], plan("p.json")["stats"]);
  std::int64_t incumbents = 0;
  std::int64_t bound = 0;
  for (const json& row : log) {
    if (&row == &log.front() || &row == &log.back() || row["event"] == "counts") continue;
    for (const char* key :
         {"time_s", "nodes", "open", "trees", "lower_bound", "incumbent", "gap", "memory_mb"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_EQ(row["event"] == "incumbent", row.contains("source"));
    const json raised_by = row.value("raised_by", json::object());
    for (const auto& [what, gain] : raised_by.items()) {
      EXPECT_THAT(what, AnyOf("individual", "wdg", "branching"));
      bound += std::int64_t(gain);
    }
    EXPECT_EQ(bound, row["lower_bound"]);  // every rise of the bound is logged
    incumbents += row["event"] == "incumbent" ? 1 : 0;
    EXPECT_EQ(row["gap"].is_null(), row["incumbent"].is_null());
  }
  EXPECT_GT(incumbents, 0);
  EXPECT_EQ(log[log.size() - 3]["gap"], 0);
  // The last counts in the log equal the stats of the plan.
  const json& counts = log[log.size() - 2];
  ASSERT_EQ(counts["event"], "counts");
  for (const auto& [name, count] : counts["counts"].items())
    EXPECT_TRUE(name == "nodes_generated" || count == log.back()["stats"][name]) << name;
  EXPECT_TRUE(counts["counts"].contains("branching_cost_queries"));
  EXPECT_GT(counts["memory_mb"]["process"], 0);
  EXPECT_FALSE(counts.contains("ranks"));
}

// Constraint trees, reconstructed from the events `root` and `node`.
struct LoggedTree {
  std::map<std::int64_t, json> open;  // nodes that have not been expanded yet
  std::int64_t expanded = 0;
  std::map<std::string, std::int64_t> splits;  // by kind

  // Checks that each node is expanded at most once, after its creation, that children are new, and
  // that no child's bound is below its parent's.
  void add(const json& event) {
    if (event["event"] == "root") open[event["node"]] = event;
    if (event["event"] != "node") return;
    ASSERT_TRUE(open.contains(event["node"])) << event;
    const std::int64_t bound = open.at(event["node"])["bound"];
    open.erase(event["node"]);
    ++expanded;
    EXPECT_EQ(event["outcome"] == "plan", event.contains("cost"));
    EXPECT_EQ(event.contains("conflict"), event.contains("split"));
    if (event.contains("split")) ++splits["splits_" + std::string(event["split"])];
    for (const json& child : event["children"]) {
      EXPECT_TRUE(open.emplace(child["node"], child).second) << event;
      EXPECT_EQ(event["outcome"] == "split", child.contains("constraint"));
      EXPECT_GE(child["bound"], bound + (event["outcome"] == "bound_raised" ? 1 : 0));
    }
  }
};

TEST_F(SolveCommand, LogsTheTreeOnRequest) {
  for (const char* threads : {"1", "2"}) {
    SCOPED_TRACE(threads);
    const ProcessResult solved =
        solve({data("rooms-32x32_n10_m30.cts.json"), "--omega", "0", "--threads", threads,
               "--log-format", "jsonl", "--log-tree", "1000000", "--without", "primal"});
    LoggedTree tree;
    const std::vector<json> log = events(solved.out);
    for (const json& event : log) tree.add(event);
    const json& stats = log.back()["stats"];
    EXPECT_EQ(tree.expanded, stats["nodes_expanded"]);
    EXPECT_GT(tree.expanded, 10);
    std::int64_t splits = 0;
    for (const auto& [name, count] : stats.items())
      if (name.starts_with("splits_")) splits += std::int64_t(count);
    std::int64_t logged = 0;
    for (const auto& [name, count] : tree.splits) logged += count;
    EXPECT_EQ(logged, splits);
  }
}

// Returns the events without times, memory, threads, options and stats.
std::vector<json> timeless_events(std::vector<json> log) {
  for (json& event : log)
    for (const char* key : {"time_s", "memory_mb", "threads", "options", "stats"}) event.erase(key);
  return log;
}

TEST_F(SolveCommand, DeterministicRunsLogTheSameTreeAndCounts) {
  std::vector<std::vector<json>> logs;
  for (const char* threads : {"1", "4"})
    logs.push_back(timeless_events(
        events(solve({data("random-32x32-20_n10_m30.cts.json"), "--omega", "0", "--deterministic",
                      "--threads", threads, "--log-format", "jsonl", "--log-tree", "100"})
                   .out)));
  EXPECT_EQ(logs[0], logs[1]);
  EXPECT_GT(logs[0].size(), 10u);
}

TEST_F(SolveCommand, LogsTheRequestedNumberOfNodes) {
  const std::vector<std::string> words{data("rooms-32x32_n10_m30.cts.json"),
                                       "--omega",
                                       "0",
                                       "--deterministic",
                                       "--without",
                                       "primal",
                                       "--log-format",
                                       "jsonl",
                                       "--log-tree",
                                       "5"};
  const std::vector<json> log = events(solve(words).out);
  EXPECT_EQ(std::ranges::count(log, "node", [](const json& e) { return e["event"]; }), 5);
  EXPECT_THAT(complaint(solve({"puzzle.json", "--log-tree", "5"})),
              HasSubstr("--log-tree: requires --log-format jsonl"));
}

TEST_F(SolveCommand, WritesAJsonLogWithoutPlanAndOnResume) {
  const ProcessResult nothing =
      solve({"puzzle.json", "--time-limit", "0", "--log-format", "jsonl"});
  EXPECT_EQ(events(nothing.out).back()["status"], "unknown");
  EXPECT_TRUE(events(nothing.out).back()["cost"].is_null());
  const ProcessResult solved =
      solve({data("first.cts.json"), "--log-format", "jsonl", "-o", "-", "--checkpoint", "kept"});
  EXPECT_EQ(events(solved.err).back()["plan_file"], "standard output");
  EXPECT_EQ(std::ranges::count(events(solved.err), "checkpoint",
                               [](const json& e) { return e["event"]; }),
            1);
  const ProcessResult resumed = solve({data("first.cts.json"), "--log-format", "jsonl",
                                       "--checkpoint", "kept", "--resume", "auto"});
  EXPECT_EQ(events(resumed.out).at(1)["event"], "resumed");
  EXPECT_THAT(complaint(solve({"puzzle.json", "--log-format", "xml"})), HasSubstr("text, jsonl"));
}

// --- checkpoint directories ---

TEST_F(SolveCommand, RefusesACheckpointDirectoryInUse) {
  std::filesystem::create_directory(directory_ / "kept");
  const std::vector<std::string> words{data("first.cts.json"), "--checkpoint", "kept", "--resume",
                                       "auto"};
  {
    const FileLock lock(directory_ / "kept/checkpoint.lock");
    EXPECT_THAT(complaint(solve(words)),
                HasSubstr("kept/checkpoint.lock: is locked by another run (process "));
  }
  EXPECT_EQ(solve(words).exit_code, 0);
}

TEST_F(SolveCommand, IgnoresAPlanTruncatedByACrash) {
  const std::vector<std::string> words{data("first.cts.json"), "--checkpoint", "kept", "--resume",
                                       "auto"};
  ASSERT_EQ(solve(words).exit_code, 0);
  directory_.write("kept/incumbent.plan.json", R"({"status": "opt)");
  const ProcessResult solved = solve(words);
  EXPECT_EQ(solved.exit_code, 0);
  EXPECT_THAT(solved.err, HasSubstr("kept/incumbent.plan.json: is incomplete"));
  EXPECT_EQ(plan("first.plan.json")["status"], "optimal");
}

// --- incumbents from heuristics and from files; incumbents written to files ---

// An instance with sixteen agents and two doors. The search finds many better plans within a
// second.
std::string doors_instance() {
  std::string agents;
  for (int i = 0; i < 8; ++i)
    agents += fmt::format(R"({}{{"id": "r{}", "start": [0, {}], "goal": [8, {}]}},
      {{"id": "l{}", "start": [8, {}], "goal": [0, {}]}})",
                          i == 0 ? "" : ",", i, i, 7 - i, i, i, 7 - i);
  return R"({"map": "doors.map", "tasks": [], "agents": [)" + agents + "]}";
}

class Incumbents : public SolveCommand {
 protected:
  Incumbents() {
    std::string map = "type octile\nheight 8\nwidth 9\nmap\n";
    for (int row = 0; row < 8; ++row) map += row == 2 || row == 5 ? ".........\n" : "....@....\n";
    directory_.write("doors.map", map);
    directory_.write("doors.json", doors_instance());
  }
};

TEST_F(Incumbents, AreFilesThatTheCheckerAccepts) {
  options_.signal = SIGINT;
  options_.signal_when = [this] { return exists("best-4.plan.json"); };
  const ProcessResult solved = solve({"doors.json", "--omega", "0", "--threads", "1",
                                      "--incumbents", "best", "--output", "p.json"});
  ASSERT_EQ(solved.exit_code, 0) << solved.err;
  options_.signal = 0;
  int k = 1;
  for (std::int64_t last = kInfiniteCost; exists(fmt::format("best-{}.plan.json", k)); ++k) {
    const std::string file = fmt::format("best-{}.plan.json", k);
    EXPECT_LT(plan(file)["cost"], last);
    last = plan(file)["cost"];
    EXPECT_EQ(run_grove({"check", "doors.json", file}, options_).exit_code, 0);
  }
  ASSERT_GT(k, 3);
  EXPECT_EQ(plan(fmt::format("best-{}.plan.json", k - 1))["cost"], plan("p.json")["cost"]);
}

// The bound of method B holds only for the destinations that it chooses, not for the instance,
// whose optimum is 4.
TEST_F(Incumbents, OfMethodBClaimOnlyBoundsOfTheInstance) {
  directory_.write("line.map", "type octile\nheight 1\nwidth 4\nmap\n....\n");
  directory_.write("line.json", R"({"map": "line.map", "agents": [
    {"id": "a", "start": [0, 0]}, {"id": "b", "start": [3, 0]}], "tasks": [
    {"id": "t", "cell": [0, 0], "agents": ["a"]}, {"id": "u", "cell": [1, 0], "agents": ["a", "b"]},
    {"id": "v", "cell": [3, 0], "agents": ["b"]}]})");
  ASSERT_EQ(solve({"line.json", "--omega", "0", "--output", "best.json"}).exit_code, 0);
  EXPECT_EQ(plan("best.json")["cost"], 4);
  const ProcessResult solved = solve({"line.json", "--omega", "0", "--method", "cts-cbs-b",
                                      "--incumbents", "b", "--output", "b.json"});
  EXPECT_EQ(plan("b.json")["status"], "feasible") << solved.err;
  EXPECT_EQ(plan("b-1.plan.json")["status"], "feasible");
  EXPECT_LE(plan("b-1.plan.json")["lower_bound"], 4);
}

TEST_F(Incumbents, HaveTheirSourceInTheLog) {
  options_.signal = SIGINT;
  options_.signal_when = [this] { return log_contains("l", "\nL  "); };
  const ProcessResult solved =
      solve({"doors.json", "--omega", "0", "--threads", "1", "--log", "l", "--output", "p.json"});
  options_.signal = 0;
  EXPECT_THAT(solved.out, HasSubstr("\nH  "));
  EXPECT_THAT(solved.out, HasSubstr("\nL  "));
  EXPECT_GT(plan("p.json")["stats"]["primal_lns_iterations"], 0);
  EXPECT_THAT(solve({data("first.cts.json"), "--threads", "1"}).out, HasSubstr("\n*  "));
  EXPECT_THAT(solve({"doors.json", "--omega", "inf", "--start", "p.json"}).out, HasSubstr("\nS  "));
}

TEST_F(Incumbents, CanStartTheNextRun) {
  solve({"doors.json", "--omega", "inf", "--output", "p.json"});
  const ProcessResult solved = solve({"doors.json", "--time-limit", "0.3", "--policy", "fixed",
                                      "--start", "p.json", "--output", "q.json"});
  ASSERT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_LE(plan("q.json")["cost"], plan("p.json")["cost"]);
}

TEST_F(Incumbents, AreRefusedAsStartIfInvalid) {
  solve({"doors.json", "--omega", "inf", "--output", "p.json"});
  const auto complaint_about = [&](const json& changed) {
    directory_.write("bad.json", changed.dump());
    return complaint(solve({"doors.json", "--start", "bad.json"}));
  };
  json changed = plan("p.json");
  changed["agents"][1]["path"][0] = {1, 1};
  EXPECT_THAT(complaint_about(changed), HasSubstr("bad.json: /agents/1/path/0: "));
  EXPECT_THAT(complaint_about(changed), HasSubstr("not a valid plan of this instance"));
  changed = plan("p.json");
  changed["cost"] = plan("p.json")["cost"].get<int>() - 1;
  EXPECT_THAT(complaint_about(changed), HasSubstr("bad.json: /cost: "));
  changed = plan("p.json");
  changed["agents"].erase(0);
  EXPECT_THAT(complaint_about(changed), HasSubstr("bad.json: /agents"));
  changed = plan("p.json");
  changed["agents"][0]["id"] = "someone";
  EXPECT_THAT(complaint_about(changed), HasSubstr("there is no agent 'someone'"));
  changed = plan("p.json");
  changed.erase("agents");
  changed.erase("cost");
  changed["status"] = "unknown";
  EXPECT_THAT(complaint_about(changed), HasSubstr("found no plan (status unknown)"));
  EXPECT_THAT(complaint(solve({"doors.json", "--start", "nowhere.json"})),
              HasSubstr("nowhere.json"));
  EXPECT_FALSE(exists("doors.plan.json"));
}

// Only the paths of a start plan are used; its claims are ignored.
TEST_F(Incumbents, DoNotSetABoundAsStart) {
  solve({"doors.json", "--omega", "inf", "--output", "p.json"});
  json changed = plan("p.json");
  changed["lower_bound"] = changed["cost"];
  changed["status"] = "optimal";
  directory_.write("claim.json", changed.dump());
  solve({"doors.json", "--omega", "0", "--time-limit", "0", "--start", "claim.json", "--output",
         "q.json"});
  EXPECT_LT(plan("q.json")["lower_bound"], plan("q.json")["cost"]);
}

TEST_F(Incumbents, DoNotReplaceOtherFilesOfTheRun) {
  solve({"doors.json", "--omega", "inf", "--output", "p-1.plan.json"});
  EXPECT_THAT(complaint(solve({"doors.json", "--incumbents", "p", "--start", "p-1.plan.json"})),
              HasSubstr("expected another prefix"));
  EXPECT_THAT(complaint(solve({"doors.json", "--incumbents", "./p", "--output", "p-12.plan.json"})),
              HasSubstr("expected another prefix"));
  EXPECT_THAT(complaint(solve({"doors.json", "--incumbents", "nowhere/p"})), HasSubstr("nowhere"));
  EXPECT_EQ(
      solve({"doors.json", "--omega", "inf", "--incumbents", "p", "--output", "p-x.plan.json"})
          .exit_code,
      0);
}

}  // namespace solve_command_test
}  // namespace grove::detail
