// SPDX-License-Identifier: MIT
// Measures the overhead of the public API by a small solve with and without it, in microseconds.
// overhead.py compares both with Python and with the program.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "engine/method.h"
#include "grove/grove.hpp"
#include "io/instance_file.h"

namespace {

const std::filesystem::path kInstance =
    std::filesystem::path(GROVE_SOURCE_DIR) / "benchmarks/data/random-32x32-20_n5_m10.cts.json";

void BM_PublicApi(benchmark::State& state) {
  const grove::Instance instance = grove::read_instance(kInstance);
  for (auto _ : state) benchmark::DoNotOptimize(grove::solve(instance));
}
BENCHMARK(BM_PublicApi)->Unit(benchmark::kMicrosecond);

void BM_Inside(benchmark::State& state) {
  const grove::detail::LoadedInstance loaded = grove::detail::read_instance(kInstance);
  grove::detail::SolveOptions options;
  options.omega = grove::detail::Omega::from_double(0);
  for (auto _ : state)
    benchmark::DoNotOptimize(grove::detail::solve(loaded.instance, options, {}, nullptr));
}
BENCHMARK(BM_Inside)->Unit(benchmark::kMicrosecond);

void BM_Reading(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(grove::read_instance(kInstance));
}
BENCHMARK(BM_Reading)->Unit(benchmark::kMicrosecond);

}  // namespace
