// SPDX-License-Identifier: MIT
// The routes of one agent by the set of stops that they visit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/limits.h"
#include "sequencing/joint_routes.h"

namespace grove::detail {

// Least costs of the beginnings of an agent's routes by the stops that they visit and their last
// stop: the recursion of Held and Karp (1962), forwards, from the end of a prefix. It takes 2^k k^2
// additions for k stops that are not part of the prefix. One thread at a time. It keeps its memory
// between calls, so reuse the object.
class RouteTable {
 public:
  static constexpr int kMaxStops = 14;  // 1 MB

  // Computes the table of the routes that begin with `prefix`, whose next stop is not in
  // `forbidden`, and that visit no stops except those of `prefix` and `allowed`. At most kMaxStops
  // stops may be left. Returns false if a limit was reached.
  bool compute(const AgentRoutes& agent, const Sequence& prefix, StopSet forbidden, StopSet allowed,
               const Limits& limits);

  // Calls visit(visited, end, cost) for each set of stops and each end of finite cost. `visited`
  // includes the prefix. For routes without stops after the prefix, is_allowed(end) must be true.
  template <class IsAllowed, class Visit>
  void for_each_route(IsAllowed is_allowed, Visit visit) const;
  // Returns a cheapest route that visits exactly `visited` and ends so. Precondition: its cost is
  // finite.
  AgentRoute route(StopSet visited, int end) const;

 private:
  StopSet expanded(std::uint32_t mask) const {
    StopSet set = visited_before_;
    for (std::size_t i = 0; i < left_.size(); ++i)
      if ((mask >> i & 1) != 0) set |= bit(left_[i]);
    return set;
  }
  Time at(std::uint32_t mask, int last) const {
    return table_[mask * left_.size() + static_cast<std::size_t>(last)];
  }
  Time cost(std::uint32_t mask, const RouteEnd& end) const;

  const AgentRoutes* agent_ = nullptr;
  Sequence prefix_;
  StopSet visited_before_ = 0;
  StopSet forbidden_ = 0;
  int last_ = 0;             // last stop of the prefix, or the start
  Time cost_before_ = 0;     // of the legs of the prefix
  Sequence left_;            // the stops that may follow
  std::vector<Time> table_;  // by set of positions in left_, then position of the last one
};

template <class IsAllowed, class Visit>
void RouteTable::for_each_route(IsAllowed is_allowed, Visit visit) const {
  const auto masks = std::uint32_t{1} << left_.size();
  for (std::uint32_t mask = 0; mask < masks; ++mask) {
    const StopSet visited = expanded(mask);
    if ((agent_->required & ~visited) != 0) continue;
    for (int end = 0; end < static_cast<int>(agent_->ends.size()); ++end) {
      const RouteEnd& by = agent_->ends[static_cast<std::size_t>(end)];
      if ((mask == 0 && !is_allowed(end)) || !may_end(*agent_, by, visited)) continue;
      if (const Time least = cost(mask, by); least < kNever) visit(visited, end, least);
    }
  }
}

}  // namespace grove::detail
