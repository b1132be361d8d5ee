// SPDX-License-Identifier: MIT
// Refusal of instances with choices, for parts of Grove that do not support them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/instance.h"

namespace grove::detail {

// A choice that an instance leaves to its agents: the destination of an agent, or which of its
// agents visit a task.
struct Choice {
  std::string field;     // its position in the instance, such as "agents/0/goals" or "tasks/2/need"
  std::string message;   // such as "agent 'a' has a choice of goals"
  std::string expected;  // what an instance without this choice has instead
};

// Returns the first choice, agent by agent; nullopt if Instance::has_choices() is false.
std::optional<Choice> find_choice(const Instance& instance);

// The choice of goals of an agent, and the choice of agents of a task. Preconditions: the agent has
// `goals`; not all agents of the task must visit it.
Choice choice_of_goals(const Instance& instance, AgentIndex agent);
Choice choice_of_agents(const Instance& instance, TaskIndex task);

// Returns "MESSAGE, which REASON; expected REMEDY, or EXPECTED"; without a remedy only "expected
// EXPECTED". Example of a reason: "policy fixed does not support"; of its remedy: "policy free".
std::string refusal_text(const Choice& choice, std::string_view reason,
                         std::string_view remedy = "");

// Remedy for parts of Grove that need only an instance without choices and a plan of it.
inline constexpr std::string_view kFixedChoices = "an instance of 'grove convert --fix-choices'";

// Throws InstanceError with refusal_text() if the instance has a choice.
void require_no_choices(const Instance& instance, std::string_view reason,
                        std::string_view remedy = "");

}  // namespace grove::detail
