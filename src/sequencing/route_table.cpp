// SPDX-License-Identifier: MIT
#include "sequencing/route_table.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::uint32_t kPollEvery = 1024;  // rows of the table

}  // namespace

bool RouteTable::compute(const AgentRoutes& agent, const Sequence& prefix, StopSet forbidden,
                         StopSet allowed, const Limits& limits) {
  agent_ = &agent;
  prefix_ = prefix;
  visited_before_ = stops_of(prefix);
  forbidden_ = forbidden;
  last_ = prefix.empty() ? agent.stops() : prefix.back();
  cost_before_ = legs_cost(agent, prefix);
  left_.clear();
  for_each_stop(allowed & all_stops(agent.stops()) & ~visited_before_,
                [&](int stop) { left_.push_back(static_cast<Stop>(stop)); });
  GROVE_CHECK(std::ssize(left_) <= kMaxStops, "a table of routes has few stops");

  const std::size_t k = left_.size();
  table_.assign((std::size_t{1} << k) * k, kNever);
  for (std::size_t i = 0; i < k; ++i)
    if ((forbidden_ & bit(left_[i])) == 0)
      table_[(std::size_t{1} << i) * k + i] = add_costs(cost_before_, agent.legs(last_, left_[i]));
  for (std::uint32_t mask = 1; mask < std::uint32_t{1} << k; ++mask) {
    if (mask % kPollEvery == 0 && limits.stop_requested()) return false;
    for (std::size_t i = 0; i < k; ++i) {
      const Time here = table_[mask * k + i];
      if (here >= kNever) continue;
      for (std::size_t j = 0; j < k; ++j) {
        if ((mask >> j & 1) != 0) continue;
        Time& there = table_[(mask | std::uint32_t{1} << j) * k + j];
        there = std::min(there, add_costs(here, agent.legs(left_[i], left_[j])));
      }
    }
  }
  return true;
}

Time RouteTable::cost(std::uint32_t mask, const RouteEnd& end) const {
  if (mask == 0) return add_costs(cost_before_, end_cost(*agent_, end, last_));
  Time least = kNever;
  for (std::size_t i = 0; i < left_.size(); ++i)
    if ((mask >> i & 1) != 0)
      least = std::min(least, add_costs(at(mask, static_cast<int>(i)), end.from_stops[left_[i]]));
  return least;
}

// Follows the recursion backwards.
AgentRoute RouteTable::route(StopSet visited, int end) const {
  const RouteEnd& by = agent_->ends[static_cast<std::size_t>(end)];
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < left_.size(); ++i)
    if ((visited & bit(left_[i])) != 0) mask |= std::uint32_t{1} << i;
  Time rest = cost(mask, by);
  GROVE_CHECK(rest < kNever, "the route exists");
  Sequence reversed;
  const auto leg_after = [&](Stop stop) {
    return reversed.empty() ? by.from_stops[stop] : agent_->legs(stop, reversed.back());
  };
  while (mask != 0) {
    std::size_t i = 0;
    while ((mask >> i & 1) == 0 ||
           add_costs(at(mask, static_cast<int>(i)), leg_after(left_[i])) != rest)
      ++i;
    rest = at(mask, static_cast<int>(i));
    reversed.push_back(left_[i]);
    mask &= ~(std::uint32_t{1} << i);
  }
  AgentRoute route{prefix_, end};
  route.stops.insert(route.stops.end(), reversed.rbegin(), reversed.rend());
  return route;
}

}  // namespace grove::detail
