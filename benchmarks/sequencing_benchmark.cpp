// SPDX-License-Identifier: MIT
// Measures sequencing for random places on random 32x32 grids: tables, K-best lists and sequence
// graphs.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <random>
#include <string>

#include "sequencing/cost_matrix.h"
#include "sequencing/k_best_joint_sequences.h"
#include "sequencing/k_best_sequences.h"
#include "sequencing/one_tree_relaxation.h"
#include "sequencing/sequence_dag.h"

namespace grove::detail {
namespace {

// Returns the cost matrix of an agent with n tasks on a grid with a fifth of its cells blocked. The
// same seed gives the same matrix.
CostMatrix random_matrix(int n, std::uint32_t seed) {
  std::mt19937 random(seed);
  constexpr int kSide = 32;
  std::vector<bool> passable(kSide * kSide);
  for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = random() % 5 != 0;
  for (int i = kSide / 4; i < kSide; ++i) passable[kSide / 2 * kSide + i] = true;
  const Grid grid(kSide, kSide, passable);
  // Draws places from the cells that are reachable from the middle, which are nearly all.
  const DistanceField reach = distance_field(grid, grid.cell({kSide / 2, kSide / 2}));
  std::vector<Cell> places;
  while (std::ssize(places) < n + 2) {
    const auto cell = static_cast<Cell>(random() % (kSide * kSide));
    if (reach[cell] < kNever && std::find(places.begin(), places.end(), cell) == places.end())
      places.push_back(cell);
  }
  InstanceBuilder builder(grid);
  const std::string agent = "a";
  builder.add_agent(agent, grid.position(places[0]), grid.position(places[1]));
  for (int i = 0; i < n; ++i)
    builder.add_task(fmt::format("t{}", i), grid.position(places[i + 2]), {&agent, 1});
  const Instance instance = std::move(builder).build();
  return cost_matrix(instance, 0, DistanceFields(instance));
}

// Measures the first query, which builds the table.
void table(benchmark::State& state) {
  const CostMatrix matrix = random_matrix(static_cast<int>(state.range(0)), 1);
  const Limits limits;
  for (auto _ : state) {
    const auto solver = make_rtsp_solver(RtspBackend::kHeldKarp, matrix, limits);
    benchmark::DoNotOptimize(solver->best({}, kNever));
  }
}
BENCHMARK(table)->Arg(10)->Arg(14)->Arg(16)->Arg(18)->Arg(20)->Arg(22)->Unit(
    benchmark::kMillisecond);

// Measures the K best sequences, without the time for the table or graph that the first one needs.
void k_best(benchmark::State& state, RtspBackend backend) {
  const CostMatrix matrix = random_matrix(static_cast<int>(state.range(0)), 1);
  const Limits limits;
  const auto count = static_cast<std::size_t>(state.range(1));
  for (auto _ : state) {
    state.PauseTiming();
    KBestSequences list(make_rtsp_solver(backend, matrix, limits), matrix, limits);
    list.resolve(0, kNever);
    state.ResumeTiming();
    benchmark::DoNotOptimize(list.resolve(count - 1, kNever));
    state.counters["rtsp_calls"] = static_cast<double>(list.rtsp_calls());
    state.counters["spread"] = list.cost_bound(count - 1) - list.cost_bound(0);
  }
}
BENCHMARK_CAPTURE(k_best, table, RtspBackend::kHeldKarp)
    ->Args({10, 200})
    ->Args({20, 1000})
    ->Args({20, 100000})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(k_best, graph, RtspBackend::kBoundedDp)
    ->Args({10, 200})
    ->Args({20, 1000})
    ->Args({20, 100000})
    ->Args({30, 1000})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(k_best, cbc, RtspBackend::kCbc)
    ->Args({10, 200})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// Measures the time to build the graph for the best sequence, and the size of the graph.
void graph(benchmark::State& state) {
  const CostMatrix matrix =
      random_matrix(static_cast<int>(state.range(0)), static_cast<std::uint32_t>(state.range(1)));
  const Limits limits;
  for (auto _ : state) {
    const auto solver = make_rtsp_solver(RtspBackend::kBoundedDp, matrix, limits);
    const RtspAnswer answer = solver->best({}, kNever);
    state.counters["cost"] = answer.cost;
    state.counters["gap"] = answer.cost - solver->root_bound();
  }
  const OneTreeRelaxation relaxation(matrix);
  const auto best = static_cast<Time>(state.counters["cost"]);
  for (Time slack : {0, 2})
    state.counters["states" + std::to_string(slack)] = static_cast<double>(
        SequenceDag::build(matrix, relaxation, best + slack, limits)->state_count());
}
BENCHMARK(graph)
    ->ArgsProduct({{10, 14, 18, 20, 24, 30, 36}, {1, 2, 3, 4, 5}})
    ->Unit(benchmark::kMillisecond);

// Measures the first joint sequences of many agents with 8 tasks each.
void joint(benchmark::State& state) {
  const auto agents = static_cast<std::uint32_t>(state.range(0));
  const Limits limits;
  std::deque<CostMatrix> matrices;
  for (std::uint32_t i = 0; i < agents; ++i) matrices.push_back(random_matrix(8, i));
  for (auto _ : state) {
    std::vector<KBestSequences> lists;
    for (const CostMatrix& matrix : matrices)
      lists.emplace_back(make_rtsp_solver(RtspBackend::kAuto, matrix, limits), matrix, limits);
    KBestJointSequences best(std::move(lists), limits);
    for (std::int64_t i = 0; i < state.range(1); ++i) benchmark::DoNotOptimize(best.next());
  }
}
BENCHMARK(joint)
    ->Args({5, 10000})
    ->Args({20, 10000})
    ->Args({200, 10000})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace grove::detail
