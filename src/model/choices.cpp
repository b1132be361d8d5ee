// SPDX-License-Identifier: MIT
#include "model/choices.h"

#include <fmt/format.h>

namespace grove::detail {

std::optional<Choice> find_choice(const Instance& instance) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    if (!agent.goals.empty())
      return Choice{fmt::format("agents/{}/goals", i),
                    fmt::format("agent '{}' has a choice of goals", agent.id), "'goal'"};
    if (!agent.options.empty())
      return Choice{
          fmt::format("tasks/{}/need", agent.options.front()),
          fmt::format("task '{}' has a choice of agents", instance.task(agent.options.front()).id),
          "no 'need' below the number of its agents"};
  }
  return std::nullopt;
}

std::string refusal_text(const Choice& choice, std::string_view reason) {
  return fmt::format("{}, which {}; expected {}", choice.message, reason, choice.expected);
}

void require_no_choices(const Instance& instance, std::string_view reason) {
  if (const auto choice = find_choice(instance))
    throw InstanceError(choice->field, refusal_text(*choice, reason));
}

}  // namespace grove::detail
