// SPDX-License-Identifier: MIT
#include "tools/generate/choices_arguments.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "tools/generate/generate_commands.h"

namespace grove::detail {
namespace {

// Title of the group of these options in the help.
constexpr const char* kGroup = "Choices";

constexpr std::array kGoalOptions = {"--any-goal", "--goal-choices", "--goal-groups"};

void require_at_most(const std::string& option, std::int64_t found, std::int64_t most,
                     const std::string& what) {
  if (found > most)
    throw CLI::ValidationError(
        option, fmt::format("found {}; expected at most {}, the number of {}", found, most, what));
}

}  // namespace

void ChoicesArguments::add_to(CLI::App& command) {
  command_ = &command;
  const auto add = [](CLI::Option* option) { option->group(kGroup); };
  add(add_integer(command, "--need", need_, kAgentNumbers,
                  "number of agents that must visit a task, any of all agents")
          ->default_str(""));
  add(add_integer(command, "--eligible", eligible_, kAgentNumbers,
                  "with --need: draw this number of agents for each task; only they may visit it")
          ->default_str(""));
  add(add_number(command, "--need-share", need_share_, 0, 1,
                 "with --need: share of the tasks to which it applies; the others keep the agents "
                 "that they have without --need"));
  add(command.add_flag("--any-goal", any_goal_,
                       "let each agent end on any of the drawn destinations"));
  add(add_integer(command, "--goal-choices", goal_choices_, {2, kAgentNumbers.max},
                  "let each agent end on any of this number of the drawn destinations: its own and "
                  "random ones")
          ->default_str(""));
  add(add_integer(command, "--goal-groups", goal_groups_, kAgentNumbers,
                  "divide the agents into this number of random groups, and let each agent end on "
                  "any destination of its group")
          ->default_str(""));
  add(add_number(command, "--goal-share", goal_share_, 0, 1,
                 "share of the agents that choose, among each other's destinations; the others "
                 "keep their own"));
}

GoalChoice ChoicesArguments::goal_choice() const {
  if (any_goal_) return GoalChoice::kAny;
  if (goal_choices_ > 0) return GoalChoice::kSome;
  return goal_groups_ > 0 ? GoalChoice::kGroups : GoalChoice::kNone;
}

void ChoicesArguments::require_consistent() const {
  const auto require = [&](const std::string& option, bool condition, const std::string& where) {
    if (!condition && command_->count(option) > 0)
      throw CLI::ValidationError(option, "allowed only " + where);
  };
  require("--eligible", need_ > 0, "with --need");
  require("--need-share", need_ > 0, "with --need");
  require("--goal-choices", !any_goal_, "without --any-goal");
  require("--goal-groups", !any_goal_, "without --any-goal");
  require("--goal-groups", goal_choices_ == 0, "without --goal-choices");
  require("--goal-share", goal_choice() != GoalChoice::kNone,
          "with --any-goal, --goal-choices or --goal-groups");
  if (eligible_ > 0 && eligible_ < need_)
    throw CLI::ValidationError(
        "--eligible",
        fmt::format("found {}; expected at least {}, the value of --need", eligible_, need_));
}

Choices ChoicesArguments::choices(std::int64_t agents, bool with_goals) const {
  require_consistent();
  for (const char* option : kGoalOptions)
    if (!with_goals && command_->count(option) > 0)
      throw CLI::ValidationError(option, "allowed only if all agents have destinations");
  require_at_most("--need", need_, agents, "agents");
  require_at_most("--eligible", eligible_, agents, "agents");
  const int choosers = share_of(goal_share_, static_cast<int>(agents));
  const std::string who = "agents that choose";
  if (goal_choices_ > 0) require_at_most("--goal-choices", goal_choices_, choosers, who);
  if (goal_groups_ > 0) require_at_most("--goal-groups", goal_groups_, choosers, who);
  return {.need = static_cast<int>(need_),
          .eligible = static_cast<int>(eligible_),
          .need_share = need_share_,
          .goals = goal_choice(),
          .goal_count = static_cast<int>(goal_choices_ > 0 ? goal_choices_ : goal_groups_),
          .goal_share = goal_share_};
}

}  // namespace grove::detail
