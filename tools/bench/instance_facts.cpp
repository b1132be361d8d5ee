// SPDX-License-Identifier: MIT
#include "tools/bench/instance_facts.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <regex>

namespace grove::bench {
namespace {

std::optional<std::int64_t> number(const std::ssub_match& digits) {
  const std::string text = digits.str();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

std::string problem_of(const Instance& instance) {
  if (instance.task_count() == 0) return "mapf";
  const auto with_goal = std::ranges::count_if(
      instance.agents(), [](const Agent& agent) { return agent.goal.has_value(); });
  return with_goal == instance.agent_count() ? "cts" : with_goal == 0 ? "mg" : "mixed";
}

}  // namespace

LoadedInstance load(const batch::Entry& entry) {
  return entry.agents > 0 ? read_scenario_instance(entry.path, entry.map, entry.agents)
                          : read_instance(entry.path);
}

InstanceFacts facts_of(const batch::Entry& entry, const LoadedInstance& loaded) {
  static const std::regex scenario("_s([0-9]+)_");
  static const std::regex tasks("_s[0-9]+_n[0-9]+_m([0-9]+)(_|$)");
  const Instance& instance = loaded.instance;
  const std::string name = std::filesystem::path(entry.id).filename().string();
  InstanceFacts facts{.map = loaded.map_path.stem().string(),
                      .agents = instance.agent_count(),
                      .tasks = instance.task_count(),
                      .problem = problem_of(instance)};
  std::smatch found;
  if (std::regex_search(name, found, scenario)) facts.scenario = number(found[1]);
  if (std::regex_search(name, found, tasks)) facts.tasks = number(found[1]).value_or(facts.tasks);
  return facts;
}

std::vector<BenchInstance> balanced(const std::vector<batch::Entry>& entries) {
  std::vector<BenchInstance> instances;
  for (const batch::Entry& entry : entries)
    instances.push_back({entry, facts_of(entry, load(entry))});
  std::ranges::stable_sort(instances, {}, [](const BenchInstance& instance) {
    return instance.facts.scenario.value_or(0);
  });
  return instances;
}

}  // namespace grove::bench
