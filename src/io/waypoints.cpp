// SPDX-License-Identifier: MIT
#include "io/waypoints.h"

#include <fmt/format.h>

#include <cstdlib>

#include "io/format_support.h"
#include "io/input_error.h"

namespace grove::detail {
namespace {

std::uint64_t key_of(Position p) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(p.x)) << 32U |
         static_cast<std::uint32_t>(p.y);
}

// Returns the position in the task's list of the agent to which `field` refers, such as 2 for
// "agents/2"; 0 for "cell".
std::size_t agent_of(const std::string& field) {
  const std::size_t slash = field.find('/');
  return slash == std::string::npos ? 0 : std::strtoul(field.c_str() + slash + 1, nullptr, 10);
}

}  // namespace

void Waypoints::add(const std::string& agent_id, Position cell, std::string place) {
  const auto [it, is_new] = stop_by_cell_.emplace(key_of(cell), stops_.size());
  if (is_new) stops_.push_back({cell, {}, {}});
  Stop& stop = stops_[it->second];
  // Calls are made agent by agent, so only the last entry can be this agent.
  if (!stop.agents.empty() && stop.agents.back() == agent_id)
    throw InputError(file_, place,
                     fmt::format("agent '{}' lists cell [{}, {}] twice; expected distinct cells",
                                 agent_id, cell.x, cell.y));
  stop.agents.push_back(agent_id);
  stop.places.push_back(std::move(place));
}

void Waypoints::add_to(InstanceBuilder& builder) const {
  for (std::size_t k = 0; k < stops_.size(); ++k) {
    const Stop& stop = stops_[k];
    try {
      builder.add_task(default_task_id(static_cast<TaskIndex>(k)), stop.cell, stop.agents);
    } catch (const InstanceError& error) {
      throw InputError(file_, stop.places[agent_of(error.field())], error.what());
    }
  }
}

}  // namespace grove::detail
