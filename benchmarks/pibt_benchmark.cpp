// SPDX-License-Identifier: MIT
// Measures the time until the first plan of LaCAM with PIBT as configuration generator, for 100
// agents and 100 tasks on a generated map, and for 250 of each on random-32-32-20 if the directory
// $GROVE_MOVINGAI contains it (as in `experiments.py crowded`). Each iteration has a different
// seed.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>

#include "io/map_file.h"
#include "io/scenario_file.h"
#include "primal/lacam_with_restarts.h"
#include "primal/visit_orders.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {
namespace {

using std::filesystem::path;

void search_to_first_plans(benchmark::State& state, const Instance& instance) {
  const Limits limits;
  const Problem problem(instance, limits);
  const auto orders = *cheapest_orders(problem, limits);
  std::uint64_t seed = 0;
  double cost = 0;
  double steps = 0;
  for (auto _ : state) {
    LacamWithRestarts search(problem, orders, seed++);
    while (search.run(limits, 1000) == LacamWithRestarts::Outcome::kWorking) {
    }
    cost += search.plan() ? static_cast<double>(search.plan()->cost) : 0;
    steps += static_cast<double>(search.configurations());
  }
  state.counters["cost"] = benchmark::Counter(cost, benchmark::Counter::kAvgIterations);
  state.counters["steps"] = benchmark::Counter(steps, benchmark::Counter::kAvgIterations);
}

void BM_GeneratedMap(benchmark::State& state) {
  const path data = path(GROVE_SOURCE_DIR) / "benchmarks" / "data";
  const Scenario scenario{"random-32x32-20.scen", read_scenario(data / "random-32x32-20.scen")};
  search_to_first_plans(state, generate_instance(read_map(data / "random-32x32-20.map"), scenario,
                                                 {100, 100, 1, false}));
}
BENCHMARK(BM_GeneratedMap)->Unit(benchmark::kMillisecond);

void BM_Dense(benchmark::State& state) {
  const char* folder = std::getenv("GROVE_MOVINGAI");
  if (!folder || !std::filesystem::exists(path(folder) / "random-32-32-20.map"))
    return state.SkipWithError("GROVE_MOVINGAI names no folder with random-32-32-20.map");
  Scenario scenario{"random-32-32-20-random-1.scen", {}};
  for (const char* file : {"random-32-32-20-random-1.scen", "random-32-32-20-random-2.scen"}) {
    const auto rows = read_scenario(path(folder) / file);
    scenario.rows.insert(scenario.rows.end(), rows.begin(), rows.end());
  }
  search_to_first_plans(state, generate_instance(read_map(path(folder) / "random-32-32-20.map"),
                                                 scenario, {250, 250, 1, false}));
}
BENCHMARK(BM_Dense)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace grove::detail
