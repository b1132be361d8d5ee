// SPDX-License-Identifier: MIT
#include "batch/instance_facts.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "model/parse_number.h"

namespace grove::detail::batch {
namespace {

namespace fs = std::filesystem;

// The number in a word that starts with `letter`: 12 for "s12" and 's'. Returns nullopt for any
// other word.
std::optional<std::int64_t> numbered(std::string_view word, char letter) {
  if (!word.starts_with(letter)) return std::nullopt;
  return parse_number<std::int64_t>(word.substr(1), 0);
}

// The numbers in a name such as room-32-32-4_s3_n5_m20_mg.
struct NamedNumbers {
  std::optional<std::int64_t> scenario;
  std::optional<std::int64_t> tasks;
};

// The number 3 in "den312d-random-3-50" or "den312d-random-3".
std::optional<std::int64_t> moving_ai_number(std::string_view name) {
  for (const std::string_view kind : {"-random-", "-even-"}) {
    const std::size_t at = name.rfind(kind);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = name.substr(at + kind.size());
    if (const auto number = parse_number<std::int64_t>(rest.substr(0, rest.find('-')), 0))
      return number;
  }
  return std::nullopt;
}

NamedNumbers numbers_in(std::string_view name) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
    end = name.find('_', begin);
    words.push_back(name.substr(begin, end - begin));
  }
  NamedNumbers numbers{.scenario = moving_ai_number(name), .tasks = std::nullopt};
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const auto scenario = numbered(words[i], 's');
    if (!scenario) continue;
    numbers.scenario = scenario;
    if (i + 2 < words.size() && numbered(words[i + 1], 'n'))
      numbers.tasks = numbered(words[i + 2], 'm');
    break;
  }
  return numbers;
}

std::string problem_of(const Instance& instance) {
  if (instance.has_choices()) return "choices";
  if (instance.task_count() == 0) return "mapf";
  const auto with_goal = std::ranges::count_if(
      instance.agents(), [](const Agent& agent) { return agent.goal.has_value(); });
  return with_goal == instance.agent_count() ? "cts" : with_goal == 0 ? "mg" : "mixed";
}

}  // namespace

InstanceMetadata metadata_of(const Entry& entry, const LoadedInstance& loaded) {
  const Instance& instance = loaded.instance;
  const NamedNumbers named = numbers_in(fs::path(entry.id).filename().string());
  return {.map = loaded.map_path.stem().string(),
          .scenario = named.scenario,
          .agents = instance.agent_count(),
          .tasks = named.tasks.value_or(instance.task_count()),
          .problem = problem_of(instance)};
}

}  // namespace grove::detail::batch
