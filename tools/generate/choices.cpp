// SPDX-License-Identifier: MIT
#include "tools/generate/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>

namespace grove::detail {
namespace {

std::string share_text(double share) {
  return share < 1 ? fmt::format("-{:g}pc", 100 * share) : "";
}

std::vector<int> draw_some(const std::vector<int>& choosers, int agent, int count, Random& random) {
  std::set<int> drawn{agent};
  while (static_cast<int>(drawn.size()) < count)
    drawn.insert(choosers[random.below(choosers.size())]);
  return {drawn.begin(), drawn.end()};
}

}  // namespace

std::string Choices::suffix() const {
  std::string text;
  if (need > 0) {
    text += fmt::format("_need{}", need);
    if (eligible > 0) text += fmt::format("of{}", eligible);
    text += share_text(need_share);
  }
  if (goals == GoalChoice::kNone) return text;
  if (goals == GoalChoice::kAny) text += "_anygoal";
  if (goals == GoalChoice::kSome) text += fmt::format("_goals{}", goal_count);
  if (goals == GoalChoice::kGroups) text += fmt::format("_groups{}", goal_count);
  return text + share_text(goal_share);
}

int share_of(double share, int count) {
  return static_cast<int>(std::lround(share * count));
}

std::vector<int> draw_share(double share, int count, Random& random) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  random.shuffle(numbers);
  numbers.resize(share_of(share, count));
  return numbers;
}

std::vector<std::vector<int>> draw_goals(const Choices& choices, int agents, Random& random) {
  std::vector<std::vector<int>> goals(agents);
  for (int i = 0; i < agents; ++i) goals[i] = {i};
  if (choices.goals == GoalChoice::kNone) return goals;
  std::vector<int> choosers = draw_share(choices.goal_share, agents, random);
  if (choices.goals == GoalChoice::kSome) {
    std::ranges::sort(choosers);
    for (const int agent : choosers)
      goals[agent] = draw_some(choosers, agent, choices.goal_count, random);
    return goals;
  }
  // The order of `choosers` is random, so every n-th of them is a random group.
  const std::size_t groups = choices.goals == GoalChoice::kAny ? 1 : choices.goal_count;
  for (std::size_t group = 0; group < std::min(groups, choosers.size()); ++group) {
    std::vector<int> members;
    for (std::size_t k = group; k < choosers.size(); k += groups) members.push_back(choosers[k]);
    std::ranges::sort(members);
    for (const int agent : members) goals[agent] = members;
  }
  return goals;
}

}  // namespace grove::detail
