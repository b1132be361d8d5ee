// SPDX-License-Identifier: MIT
#include "assignment/goal_choice.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sequencing/assignment.h"

namespace grove::detail {

std::vector<Place> all_destinations(const Instance& instance,
                                    const std::function<bool(const Agent&)>& include) {
  std::vector<Place> places;
  for (const Agent& agent : instance.agents())
    if (include(agent))
      for (const Place place : agent.destinations()) places.push_back(place);
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

std::vector<Place> all_destinations(const Instance& instance) {
  return all_destinations(instance, [](const Agent&) { return true; });
}

std::optional<ChosenGoals> cheapest_goals(
    const Instance& instance, const std::function<std::optional<Cost>(AgentIndex, Place)>& cost) {
  const std::vector<Place> places = all_destinations(instance);
  std::vector<AgentIndex> rows;
  std::vector<std::vector<std::int64_t>> matrix;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    if (!instance.agent(agent).has_destination()) continue;
    rows.push_back(agent);
    matrix.emplace_back(places.size(), kForbidden);
    for (const Place goal : instance.agent(agent).destinations()) {
      const auto column = std::ranges::lower_bound(places, goal) - places.begin();
      matrix.back()[static_cast<std::size_t>(column)] = cost(agent, goal).value_or(kForbidden);
    }
  }
  const auto assignment = min_cost_assignment(matrix);
  if (!assignment) return std::nullopt;
  ChosenGoals choice{.goals = std::vector<std::optional<Place>>(instance.agents().size()),
                     .prices = assignment->prices};
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto column = static_cast<std::size_t>(assignment->columns[row]);
    choice.goals[rows[row]] = places[column];
    choice.cost += matrix[row][column];
  }
  return choice;
}

}  // namespace grove::detail
