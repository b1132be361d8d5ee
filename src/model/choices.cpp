// SPDX-License-Identifier: MIT
#include "model/choices.h"

#include <fmt/format.h>

namespace grove::detail {

std::optional<Choice> find_choice(const Instance& instance) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    if (!agent.goals.empty()) return choice_of_goals(instance, i);
    if (!agent.options.empty()) return choice_of_agents(instance, agent.options.front());
  }
  return std::nullopt;
}

Choice choice_of_goals(const Instance& instance, AgentIndex agent) {
  return {fmt::format("agents/{}/goals", agent),
          fmt::format("agent '{}' has a choice of goals", instance.agent(agent).id), "'goal'"};
}

Choice choice_of_agents(const Instance& instance, TaskIndex task) {
  return {fmt::format("tasks/{}/need", task),
          fmt::format("task '{}' has a choice of agents", instance.task(task).id),
          "no 'need' below the number of its agents"};
}

std::string refusal_text(const Choice& choice, std::string_view reason, std::string_view remedy) {
  return fmt::format("{}, which {}; expected {}{}{}", choice.message, reason, remedy,
                     remedy.empty() ? "" : ", or ", choice.expected);
}

void require_no_choices(const Instance& instance, std::string_view reason,
                        std::string_view remedy) {
  if (const auto choice = find_choice(instance))
    throw InstanceError(choice->field, refusal_text(*choice, reason, remedy));
}

}  // namespace grove::detail
