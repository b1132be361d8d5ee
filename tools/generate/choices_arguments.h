// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <cstdint>

#include "tools/generate/choices.h"

namespace grove::detail {

// The options --need, --eligible, --need-share, --any-goal, --goal-choices, --goal-groups and
// --goal-share. The object must outlive the parsing of the command line.
class ChoicesArguments {
 public:
  void add_to(CLI::App& command);

  // Returns the choices. `agents`: the least number of agents of an instance. `with_goals`: whether
  // all agents will have destinations. Throws CLI::ValidationError if the arguments contradict each
  // other or the number of agents.
  Choices choices(std::int64_t agents, bool with_goals) const;

 private:
  GoalChoice goal_choice() const;
  void require_consistent() const;

  std::int64_t need_ = 0;
  std::int64_t eligible_ = 0;
  double need_share_ = 1;
  bool any_goal_ = false;
  std::int64_t goal_choices_ = 0;
  std::int64_t goal_groups_ = 0;
  double goal_share_ = 1;
  const CLI::App* command_ = nullptr;
};

}  // namespace grove::detail
