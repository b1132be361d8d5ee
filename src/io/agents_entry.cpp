// SPDX-License-Identifier: MIT
#include "io/agents_entry.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

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

}  // namespace grove::detail
