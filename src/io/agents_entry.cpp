// SPDX-License-Identifier: MIT
#include "io/agents_entry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "io/input_error.h"

namespace grove::detail {
namespace {

constexpr std::string_view kAll = "*";

}  // namespace

bool is_for_all_agents(const JsonValue& task) {
  const JsonValue agents = task.member("agents");
  if (!agents.json().is_string()) return false;
  if (agents.text() != kAll) agents.fail_expected("a list of ids, or \"*\" for all agents");
  return true;
}

std::vector<std::string> agents_of_task(const JsonValue& task,
                                        const std::function<std::vector<std::string>()>& all_ids) {
  if (is_for_all_agents(task)) return all_ids();
  const JsonValue agents = task.member("agents");
  std::vector<std::string> ids = agents.texts();
  const auto star = std::ranges::find(ids, kAll);
  if (star != ids.end() && std::ranges::count(all_ids(), kAll) == 0)
    agents.element(static_cast<std::size_t>(star - ids.begin()))
        .fail(
            "there is no agent '*'; expected \"agents\": \"*\", without brackets, for all agents");
  return ids;
}

std::optional<int> need_of_task(const JsonValue& task, std::size_t agents) {
  const auto need = task.find("need");
  if (!need || agents == 0) return std::nullopt;
  return static_cast<int>(
      need->integer(1, static_cast<std::int64_t>(agents), ", the number of agents of the task"));
}

std::vector<std::string> hints_on_need(const JsonValue& tasks, std::size_t agents,
                                       const std::string& file) {
  const bool is_list = tasks.json().is_array();
  std::size_t count = 0;
  std::string first = one_line(file);
  for (std::size_t i = 0; i < (is_list ? tasks.size() : 1) && agents > 1; ++i) {
    const JsonValue task = is_list ? tasks.element(i) : tasks;
    if (!is_for_all_agents(task) || task.find("need")) continue;
    if (count++ == 0 && is_list) first += ": " + task.path();
  }
  if (count == 0) return {};
  return {fmt::format(
      "{}: \"agents\": \"*\" without \"need\" means that all {} agents must visit the "
      "task{}; if any one of them may do so, add \"need\": 1",
      first, agents, count == 1 ? "" : fmt::format(" (the first of {} such tasks)", count))};
}

}  // namespace grove::detail
