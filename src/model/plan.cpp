// SPDX-License-Identifier: MIT
#include "grove/model/plan.h"

#include <array>
#include <utility>

namespace grove {
namespace {

constexpr std::array<std::pair<Status, std::string_view>, 5> kNames{{
    {Status::kOptimal, "optimal"},
    {Status::kBounded, "bounded"},
    {Status::kFeasible, "feasible"},
    {Status::kInfeasible, "infeasible"},
    {Status::kUnknown, "unknown"},
}};

}  // namespace

Time last_arrival(const World& world, const Path& path) {
  Time time = static_cast<Time>(path.size()) - 1;
  while (time > 0 && world.place(path[time - 1]) == world.place(path.back())) --time;
  return time;
}

std::string_view to_string(Status status) {
  for (const auto& [value, name] : kNames)
    if (value == status) return name;
  return "";
}

std::optional<Status> parse_status(std::string_view text) {
  for (const auto& [value, name] : kNames)
    if (name == text) return value;
  return std::nullopt;
}

Status status_of(std::optional<Cost> cost, Cost lower_bound, Omega omega) {
  if (!cost) return Status::kUnknown;
  if (*cost <= lower_bound) return Status::kOptimal;
  // With w = inf nothing was asked for that the bound could prove.
  if (!omega.is_infinite() && omega.accepts(*cost, lower_bound)) return Status::kBounded;
  return Status::kFeasible;
}

}  // namespace grove
