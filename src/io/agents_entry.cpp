// SPDX-License-Identifier: MIT
#include "io/agents_entry.h"

namespace grove::detail {

bool is_for_all_agents(const JsonValue& task) {
  const JsonValue agents = task.member("agents");
  if (!agents.json().is_string()) return false;
  if (agents.text() != "*") agents.fail_expected("a list of ids, or \"*\" for all agents");
  return true;
}

}  // namespace grove::detail
