// SPDX-License-Identifier: MIT
// Tests the benchmark workers with a shell script as a replacement for the solver.
#include "tools/bench/bench_run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <set>

#include "io/input_error.h"
#include "io/text_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"
#include "tools/bench/method_support.h"

namespace grove::detail::bench {
namespace bench_run_test {

using batch::Row;

namespace fs = std::filesystem;

// A plan in a corridor of three cells.
constexpr const char* kPlan =
    R"({"status": "optimal", "cost": 2, "lower_bound": 2, "omega": 0, "agents": [{"id": "a",
        "sequence": [], "cost": 2, "path": [[0, 0], [1, 0], [2, 0]]}], "stats": {"version": "v"}})";

class Benches : public ::testing::Test {
 protected:
  Benches() {
    directory_.write("a.map", "type octile\nheight 1\nwidth 3\nmap\n...\n");
    options_.folder = directory_ / "out";
    options_.version = "mine";
    options_.stopped = [this] { return stopped_.load(); };
    options_.watch = [](const BenchState&) {};
    solver("cp '" + directory_.write("good", kPlan) + "' \"$plan\"");
  }

  // Sets a solver program that runs `script`, in which "$plan" is the plan file to write.
  void solver(const std::string& script) {
    options_.program =
        directory_.write("solver", "#!/bin/sh\nlog='" + (directory_ / "log") +
                                       "'\necho \"$*\" >> \"$log\"\n"
                                       "while [ \"$1\" != --output ]; do shift; done\nplan=$2\n" +
                                       script + "\n");
    fs::permissions(options_.program, fs::perms::owner_all);
  }
  void instances(int count) {
    for (int k = 0; k < count; ++k) {
      const std::string id = "i" + std::to_string(k);
      const std::string path = directory_.write(
          id + ".cts.json",
          R"({"map": "a.map", "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}],
              "tasks": []})");
      instances_.push_back({{.id = id, .path = path}, {"a", std::nullopt, 1, 0, "mapf"}});
    }
  }
  void methods(int count) {
    for (int k = 0; k < count; ++k)
      methods_.push_back({.settings = {.method = "m" + std::to_string(k),
                                       .options = "--k " + std::to_string(k),
                                       .omega = "0.5",
                                       .time_limit_s = 60},
                          .arguments = {"--k", std::to_string(k)}});
  }
  BenchState run() { return run_bench(instances_, methods_, options_); }
  std::vector<Row> rows() const {
    std::vector<Row> rows;
    const std::string text = file_content(directory_ / "out/results.jsonl");
    for (const std::string_view line : split_lines(text))
      rows.push_back(batch::parse_json_line(line));
    return rows;
  }

  TemporaryDirectory directory_;
  std::vector<BenchInstance> instances_;
  std::vector<Method> methods_;
  BenchOptions options_;
  std::atomic<bool> stopped_ = false;
};

TEST_F(Benches, WriteOneRowPerPairWithAnyNumberOfWorkers) {
  instances(7);
  methods(3);
  options_.jobs = 5;
  const BenchState state = run();
  EXPECT_EQ(state.work.done, 21);
  EXPECT_EQ(state.work.left, 0);
  std::set<std::pair<std::string, std::string>> pairs;
  for (const Row& row : rows()) {
    pairs.emplace(row.run.instance, row.run.settings.method);
    EXPECT_TRUE(row.outcome.solved) << row.outcome.error;
    EXPECT_EQ(row.outcome.cost, 2);
    EXPECT_EQ(row.run.settings.omega, "0.5");
    EXPECT_EQ(row.outcome.version, "v");
    EXPECT_EQ(row.root_cost, 2);
  }
  EXPECT_EQ(pairs.size(), 21U);
  EXPECT_EQ(rows().size(), 21U);
  EXPECT_FALSE(fs::exists(directory_ / "out/.running"));
}

TEST_F(Benches, RunAllMethodsInstanceByInstance) {
  instances(2);
  methods(2);
  run();
  const std::string text = file_content(directory_ / "log");
  const auto lines = split_lines(text);
  ASSERT_EQ(lines.size(), 4U);
  const std::string files = directory_ / "out/.running/0";
  const auto expected = [&](int i, int k) {
    return "solve " + (directory_ / ("i" + std::to_string(i) + ".cts.json")) + " --k " +
           std::to_string(k) + " --time-limit 60 --output " + files + ".plan.json --quiet --log " +
           files + ".jsonl --log-format jsonl";
  };
  EXPECT_EQ(lines[0], expected(0, 0));
  EXPECT_EQ(lines[1], expected(0, 1));
  EXPECT_EQ(lines[2], expected(1, 0));
  EXPECT_EQ(lines[3], expected(1, 1));
}

TEST_F(Benches, CountLatePlansAsUnsolved) {
  instances(1);
  methods(1);
  methods_[0].settings.time_limit_s = 1e-6;  // the start of a process alone takes longer
  solver("cp '" + (directory_ / "good") + "' \"$plan\"");
  run();
  ASSERT_EQ(rows().size(), 1U);
  EXPECT_FALSE(rows()[0].outcome.solved);
  EXPECT_EQ(rows()[0].outcome.error, "time limit");
  EXPECT_EQ(rows()[0].outcome.cost, 2);
  EXPECT_EQ(rows()[0].runtime_s(), 1e-6);
}

TEST_F(Benches, UseNoFilesOfThePreviousRun) {
  instances(2);
  methods(1);
  solver("[ $(wc -l < \"$log\") -eq 1 ] && cp '" + (directory_ / "good") + "' \"$plan\"; exit 0");
  run();
  ASSERT_EQ(rows().size(), 2U);
  EXPECT_TRUE(rows()[0].outcome.solved);
  EXPECT_TRUE(rows()[1].outcome.failed());
  EXPECT_TRUE(rows()[1].outcome.error.starts_with("the plan file is wrong"))
      << rows()[1].outcome.error;
  EXPECT_EQ(rows()[1].outcome.version, "mine");
}

TEST_F(Benches, RefuseInvalidPlans) {
  instances(1);
  methods(1);
  std::string plan = kPlan;
  plan.replace(plan.find("[1, 0]"), 6, "[2, 0]");
  directory_.write("good", plan);
  run();
  EXPECT_TRUE(rows().at(0).outcome.failed());
  EXPECT_TRUE(rows().at(0).outcome.error.starts_with("the plan is wrong: /agents/0/path/1"))
      << rows().at(0).outcome.error;
}

TEST_F(Benches, KillSolversThatDoNotEnd) {
  instances(1);
  methods(1);
  methods_[0].settings.time_limit_s = 0;
  options_.grace_s = 0;
  solver("exec sleep 600");
  run();
  EXPECT_TRUE(rows().at(0).outcome.error.starts_with("did not end; killed"))
      << rows().at(0).outcome.error;
}

TEST_F(Benches, KeepPlansOnRequest) {
  instances(1);
  methods(2);
  options_.keep_plans = true;
  instances_[0].entry.id = "set/i";
  run();
  EXPECT_EQ(file_content(directory_ / "out/plans/m0/set/i.plan.json"), kPlan);
  EXPECT_EQ(file_content(directory_ / "out/plans/m1/set/i.plan.json"), kPlan);
  EXPECT_EQ(rows()[1].plan_file, "plans/m1/set/i.plan.json");
  fs::remove(fs::path(options_.folder) / rows()[1].plan_file);
  run();  // repeats only the run whose plan is missing
  EXPECT_EQ(file_content(directory_ / "out/plans/m1/set/i.plan.json"), kPlan);
  EXPECT_EQ(rows().size(), 2U);
}

TEST_F(Benches, WriteNoRowsOfRunsInProgressWhenStopped) {
  instances(3);
  methods(1);
  options_.jobs = 2;
  solver("mkdir \"$log.first\" 2>/dev/null || exec sleep 600; cp '" + (directory_ / "good") +
         "' \"$plan\"");
  options_.watch = [this](const BenchState& state) { stopped_ = state.work.done == 1; };
  EXPECT_EQ(run().work.left, 2);
  EXPECT_EQ(rows().size(), 1U);
  stopped_ = false;
  options_.watch = [](const BenchState&) {};
  solver("cp '" + (directory_ / "good") + "' \"$plan\"");
  EXPECT_EQ(run().work.left, 0);
  EXPECT_EQ(rows().size(), 3U);
}

TEST_F(Benches, CheckMethodSupportOnEachKindOfInstance) {
  instances(3);
  methods(2);
  instances_[2].kind = "mg";
  solver("");
  check_method_support(instances_, methods_, options_);
  const std::string text = file_content(directory_ / "log");
  ASSERT_EQ(split_lines(text).size(), 2U);  // one call per method: the first instance is accepted
  for (const std::string_view line : split_lines(text))
    EXPECT_NE(line.find(" --time-limit 0 "), std::string_view::npos) << line;

  for (const char* other : {"exit 1", "kill $$"}) {  // neither is a refusal
    solver(other);
    EXPECT_NO_THROW(check_method_support(instances_, methods_, options_));
  }
  solver("case $(tail -n 1 \"$log\") in *i0.cts.json*--k\\ 1*) echo 'grove: error: " +
         instances_[0].entry.path + ": not for me'; exit 2;; esac");
  EXPECT_NO_THROW(check_method_support(instances_, methods_, options_));
  solver("echo 'grove: error: not for me'; exit 2");
  EXPECT_EQ(refusal([&] { check_method_support(instances_, methods_, options_); }).substr(2),
            ".cts.json: the method of run 'm0' does not accept it: not for me");
  EXPECT_FALSE(fs::exists(options_.folder));
}

TEST_F(Benches, RefusedInstanceIsUnsuitable) {
  instances(2);
  methods(1);
  solver("case $(tail -n 1 \"$log\") in *i1.cts.json*) echo 'grove: error: " +
         instances_[1].entry.path + ": not for me'; exit 2;; esac; cp '" + (directory_ / "good") +
         "' \"$plan\"");
  const BenchState state = run();
  EXPECT_EQ(state.counts.at("m0").unsupported, 1);
  EXPECT_EQ(state.counts.at("m0").errors, 0);
  ASSERT_EQ(rows().size(), 2U);
  EXPECT_EQ(rows()[1].outcome.status, batch::kUnsupported);
  EXPECT_EQ(rows()[1].outcome.error, "not for me");
}

TEST_F(Benches, UnreadableInstanceGetsARow) {
  instances(2);
  methods(1);
  instances_[0].error = "i0.cts.json: is broken";
  const BenchState state = run();
  EXPECT_EQ(state.counts.at("m0").errors, 1);
  EXPECT_EQ(state.counts.at("m0").solved, 1);
  ASSERT_EQ(rows().size(), 2U);
  EXPECT_EQ(rows()[0].outcome.error, "i0.cts.json: is broken");
}

TEST_F(Benches, EndOnFileErrors) {
  instances(4);
  methods(1);
  options_.jobs = 3;
  solver("rm -rf '" + (directory_ / "out/.running") + "'; exit 0");
  EXPECT_ANY_THROW(run());
}

}  // namespace bench_run_test
}  // namespace grove::detail::bench
