// SPDX-License-Identifier: MIT
// Choices in generated instances: tasks that only some of their agents visit, and agents that
// choose their destination.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/generate/random.h"

namespace grove::detail {

// The destinations from which an agent chooses.
enum class GoalChoice : std::uint8_t {
  kNone,    // only its own
  kAny,     // those of all agents that choose
  kSome,    // its own, and random ones of the other agents that choose
  kGroups,  // those of its group; the agents that choose are divided into groups
};

struct Choices {
  int need = 0;           // of its agents that must visit a task; 0: all, without a choice
  int eligible = 0;       // number of agents of such a task; 0: all that can reach it
  double need_share = 1;  // of the tasks with `need`, 0 to 1; the others are as without `need`
  GoalChoice goals = GoalChoice::kNone;
  int goal_count = 0;     // kSome: destinations of an agent; kGroups: number of groups
  double goal_share = 1;  // of the agents that choose their destination, 0 to 1

  // Returns a suffix for file names, such as "_need1of5_anygoal-50pc"; "" without choices.
  std::string suffix() const;
};

// Returns share * count, rounded.
int share_of(double share, int count);

// Draws share_of(share, count) of the numbers 0, ..., count - 1, in random order. With the same
// state of `random`, a smaller share gives the first numbers of a larger share.
std::vector<int> draw_share(double share, int count, Random& random);

// Returns, for each of `agents` agents, the agents whose drawn destinations it may choose, in
// ascending order; only the agent itself if it does not choose. Each list contains the agent
// itself, so the agents can choose distinct destinations. Precondition for kSome and kGroups:
// goal_count is in 1, ..., share_of(goal_share, agents), or no agent chooses.
std::vector<std::vector<int>> draw_goals(const Choices& choices, int agents, Random& random);

}  // namespace grove::detail
