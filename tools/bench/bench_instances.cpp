// SPDX-License-Identifier: MIT
#include "tools/bench/bench_instances.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/input_error.h"

namespace grove::detail::bench {
namespace {

// Returns the properties of the instance that determine whether a method accepts it; see
// require_fit() in engine/method.h.
std::string kind_of(const batch::InstanceMetadata& facts, const Instance& instance) {
  const bool idles = std::ranges::any_of(instance.agents(), &Agent::is_idle);
  const bool shares_cells = std::ranges::any_of(instance.agents(), [](const Agent& agent) {
    return agent.stops.size() < agent.tasks.size();
  });
  return fmt::format("{}{}{}{}{}", facts.problem, instance.motion_world() ? " motion" : "",
                     instance.world().is_plain() ? "" : " one-way", idles ? " idle" : "",
                     shares_cells ? " shared-cells" : "");
}

BenchInstance read(const batch::Entry& entry) {
  try {
    const LoadedInstance loaded = load(entry);
    const batch::InstanceMetadata facts = metadata_of(entry, loaded);
    return {.entry = entry, .facts = facts, .kind = kind_of(facts, loaded.instance)};
  } catch (const InputError& error) {
    return {.entry = entry, .facts = {}, .error = error.what()};
  }
}

}  // namespace

std::vector<BenchInstance> balanced(const std::vector<batch::Entry>& entries) {
  std::vector<BenchInstance> instances;
  for (const batch::Entry& entry : entries) instances.push_back(read(entry));
  std::ranges::stable_sort(instances, {}, [](const BenchInstance& instance) {
    return instance.facts.scenario.value_or(0);
  });
  return instances;
}

}  // namespace grove::detail::bench
