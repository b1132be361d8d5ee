// SPDX-License-Identifier: MIT
// Measures constraint-tree expansions per second and memory per node with the fixed policy and
// omega = 0, for 10 agents and 20 tasks, and for 20 agents and 50 tasks. The map is random-32-32-20
// if the directory $GROVE_MOVINGAI contains it, otherwise a similar generated map. The benchmark
// ignores plans, so the search never ends early.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/map_file.h"
#include "io/scenario_file.h"
#include "search/expander.h"
#include "search/frontier.h"
#include "search/sequence_forest.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {
namespace {

struct Source {
  std::filesystem::path map;
  std::filesystem::path scenario;
};

Source source() {
  const char* folder = std::getenv("GROVE_MOVINGAI");
  if (folder && std::filesystem::exists(std::filesystem::path(folder) / "random-32-32-20.map"))
    return {std::filesystem::path(folder) / "random-32-32-20.map",
            std::filesystem::path(folder) / "random-32-32-20-random-1.scen"};
  const std::filesystem::path data =
      std::filesystem::path(GROVE_SOURCE_DIR) / "benchmarks" / "data";
  return {data / "random-32x32-20.map", data / "random-32x32-20.scen"};
}

// Expands the best node in each step, and instantiates trees like Algorithm 4 of the paper with
// omega = 0.
class Search {
 public:
  explicit Search(const Instance& instance)
      : problem_(instance, limits_),
        forest_(problem_, pool_, RtspBackend::kAuto, limits_),
        stops_(instance, problem_.distances),
        expander_(problem_, stops_, {Techniques(), 0}) {
    grow();
  }
  ~Search() { frontier_.abandon(); }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  void step() {
    if (frontier_.bound() > last_tree_cost_) grow();
    const NodePtr node = frontier_.take();
    const Expansion expansion = expander_.expand(node, kInfiniteCost, limits_);
    for (const NodePtr& child : expansion.children) frontier_.push(child);
    generated_ += static_cast<std::int64_t>(expansion.children.size());
    frontier_.complete(node);
  }

  std::int64_t generated() const { return generated_; }
  ExpansionCounts counts() const { return expander_.counts(); }
  double node_bytes() const { return pool_.mean_bytes(); }

 private:
  void grow() {
    NodePtr root = forest_.next_root();
    if (!root) return;
    last_tree_cost_ = root->cost();
    frontier_.push(std::move(root));
  }

  Limits limits_;
  Problem problem_;
  NodePool pool_;
  SequenceForest forest_;
  Frontier frontier_;
  AgentStopsCache stops_;
  Expander expander_;
  Cost last_tree_cost_ = 0;
  std::int64_t generated_ = 0;
};

void BM_Expansions(benchmark::State& state) {
  const Source files = source();
  const Scenario scenario{files.scenario.string(), read_scenario(files.scenario)};
  const Instance instance = generate_instance(
      read_map(files.map), scenario,
      {static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 1, false});
  Search search(instance);
  search.step();  // fills tables and buffers
  const auto memory_before = static_cast<double>(resident_bytes());
  for (auto _ : state) search.step();
  const auto nodes = static_cast<double>(search.generated());
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
  state.counters["bytes_per_node"] =
      (static_cast<double>(resident_bytes()) - memory_before) / nodes;
  state.counters["node_bytes"] = search.node_bytes();  // memory for nodes and their paths
  const Counters counts = search.counts().reported;
  state.counters["labels_per_call"] = static_cast<double>(counts[Counter::kLowLevelExpanded]) /
                                      static_cast<double>(counts[Counter::kLowLevelCalls]);
  state.SetLabel(files.map.filename().string());
}
BENCHMARK(BM_Expansions)
    ->ArgNames({"agents", "tasks"})
    ->Args({10, 20})
    ->Args({20, 50})
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(100'000);

}  // namespace
}  // namespace grove::detail
