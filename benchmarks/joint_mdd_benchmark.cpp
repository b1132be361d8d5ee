// SPDX-License-Identifier: MIT
// Measures the time to build MDDs (for all agents) and the joint MDD test (for all pairs of agents)
// on instances generated as in the paper. Each agent gets vertex constraints, at most a given
// number, each on the optimal path under the previous ones.
//
// The time shown is the median over the agents or pairs of one pass; worst_us is the maximum. Maps
// and scenarios are those of Moving AI in the directory $GROVE_MOVINGAI.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "io/map_file.h"
#include "io/scenario_file.h"
#include "planning/free_order_sipp.h"
#include "planning/joint_mdd_search.h"
#include "planning/mdd.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxNodes = 20'000;
constexpr std::size_t kMaxPairs = 20'000;

double microseconds_of(const auto& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return 1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<int>(values.size()) / 2);
  return values[values.size() / 2];
}

struct Agent {
  std::unique_ptr<AgentStops> stops;
  std::unique_ptr<SequenceStages> goals;
  std::vector<Constraint> constraints;
  Time cost = 0;
  MddBuilder::Outcome outcome{};
  Mdd paths;
};

class Agents {
 public:
  Agents(const std::filesystem::path& folder, const std::string& map, int constraints)
      : instance_(instance_of(folder, map)),
        distances_(instance_),
        builder_(instance_.grid()),
        pair_(instance_.grid()) {
    FreeOrderSipp search(instance_.grid());
    std::mt19937 random(1);
    for (AgentIndex a = 0; a < instance_.agent_count(); ++a) {
      Agent& agent = agents_.emplace_back();
      agent.stops = std::make_unique<AgentStops>(instance_, distances_, a);
      agent.goals = std::make_unique<SequenceStages>(*agent.stops, SequenceClass{});
      constrain(agent, search, constraints, random);
    }
  }

  // Builds the MDDs. Returns the time for each agent in microseconds.
  std::vector<double> build() {
    std::vector<double> times;
    for (Agent& a : agents_)
      times.push_back(microseconds_of([&] {
        a.outcome = builder_.build(*a.goals, a.constraints, a.cost, kMaxNodes, Limits(), a.paths);
      }));
    return times;
  }
  // Tests all pairs of agents with MDDs. Returns the time for each of these pairs in microseconds,
  // and counts the answers.
  std::vector<double> test(std::vector<int>& answers) {
    answers.assign(3, 0);
    std::vector<double> times;
    for (std::size_t i = 0; i < agents_.size(); ++i)
      for (std::size_t j = i + 1; j < agents_.size(); ++j) {
        if (agents_[i].paths.empty() || agents_[j].paths.empty()) continue;
        Dependence answer{};
        times.push_back(microseconds_of(
            [&] { answer = pair_.find(agents_[i].paths, agents_[j].paths, kMaxPairs, Limits()); }));
        ++answers[static_cast<std::size_t>(answer)];
      }
    return times;
  }
  const std::vector<Agent>& all() const { return agents_; }

 private:
  static Instance instance_of(const std::filesystem::path& folder, const std::string& map) {
    const std::filesystem::path scenario = folder / (map + "-random-1.scen");
    return generate_instance(read_map(folder / (map + ".map")),
                             {scenario.string(), read_scenario(scenario)}, {20, 50, 1, false});
  }

  static void constrain(Agent& agent, FreeOrderSipp& search, int count, std::mt19937& random) {
    Path path;
    const auto find = [&] {
      return search.find(*agent.goals, {.constraints = agent.constraints}, Limits(), path);
    };
    find();
    for (int n = 0; n < count; ++n) {
      const auto t = static_cast<Time>(1 + random() % (path.size() - 1));
      agent.constraints.push_back({path[t], kNoCell, t, t});
      if (find() != PathOutcome::kFound) agent.constraints.pop_back();
    }
    agent.cost = static_cast<Time>(path.size()) - 1;
  }

  Instance instance_;
  DistanceFields distances_;
  MddBuilder builder_;
  JointMddSearch pair_;
  std::vector<Agent> agents_;
};

void build_graphs(benchmark::State& state, const std::filesystem::path& folder,
                  const std::string& map) {
  Agents agents(folder, map, static_cast<int>(state.range(0)));
  std::vector<double> times;
  for (auto _ : state) state.SetIterationTime(median(times = agents.build()) * 1e-6);
  std::vector<double> nodes;
  for (const Agent& a : agents.all()) nodes.push_back(a.paths.node_count());
  state.counters["worst_us"] = *std::ranges::max_element(times);
  state.counters["nodes"] = median(nodes);
  state.counters["max_nodes"] = *std::ranges::max_element(nodes);
  state.counters["too_large"] = static_cast<double>(
      std::ranges::count(agents.all(), MddBuilder::Outcome::kTooLarge, &Agent::outcome));
}

void test_pairs(benchmark::State& state, const std::filesystem::path& folder,
                const std::string& map) {
  Agents agents(folder, map, static_cast<int>(state.range(0)));
  agents.build();
  std::vector<double> times;
  std::vector<int> answers;
  for (auto _ : state) state.SetIterationTime(median(times = agents.test(answers)) * 1e-6);
  state.counters["worst_us"] = *std::ranges::max_element(times);
  state.counters["independent"] = answers[static_cast<std::size_t>(Dependence::kIndependent)];
  state.counters["dependent"] = answers[static_cast<std::size_t>(Dependence::kDependent)];
  state.counters["unknown"] = answers[static_cast<std::size_t>(Dependence::kUnknown)];
}

const bool kRegistered = [] {
  const char* folder = std::getenv("GROVE_MOVINGAI");
  if (!folder) return false;
  for (const std::string map : {"empty-32-32", "random-32-32-20", "room-32-32-4"}) {
    const auto add = [&](const std::string& name, auto run) {
      benchmark::RegisterBenchmark((name + "/" + map).c_str(), run, folder, map)
          ->ArgName("constraints")
          ->Arg(0)
          ->Arg(10)
          ->Arg(30)
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond)
          ->Iterations(20);
    };
    add("build", build_graphs);
    add("pair", test_pairs);
  }
  return true;
}();

}  // namespace
}  // namespace grove::detail
