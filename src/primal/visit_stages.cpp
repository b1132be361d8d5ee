// SPDX-License-Identifier: MIT
#include "visit_stages.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace grove::detail {
namespace {

bool is_complete(Sequence order, std::size_t stops) {
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != i) return false;
  return order.size() == stops;
}

}  // namespace

VisitStages::VisitStages(const Problem& problem, AgentIndex agent, Sequence order)
    : instance_(problem.instance),
      agent_(agent),
      start_(problem.instance.agent(agent).start),
      order_(std::move(order)) {
  if (!is_complete(order_, stops().size()))
    throw std::invalid_argument("an order must hold every stop of its agent once");
  for (const TaskIndex task : stops()) {
    places_.push_back(instance_.task(task).cell);
    to_stop_.push_back(problem.distances.to_task(task));
  }
  to_rest_ = instance_.rests_on_last_stop(agent) ? to_stop_[order_.back()]
                                                 : problem.distances.to_rest(agent);
  all_ = make(all_stops(static_cast<int>(stops().size())));
}

VisitStages::Stage VisitStages::make(StopSet left) {
  Distances to_next = to_rest_;
  std::int64_t onward = 0;
  Place from = kNoPlace;
  const auto go_on = [&](Distances to) {
    if (from == kNoPlace)
      to_next = to;
    else
      onward += least_from(instance_.world(), from, instance_.agent(agent_).kind, to);
  };
  for (Stop stop : order_) {
    if ((left >> stop & 1) == 0) continue;
    go_on(to_stop_[stop]);
    from = places_[stop];
  }
  go_on(to_rest_);
  const auto stage = static_cast<Stage>(entries_.size());
  entries_.push_back(
      {left, to_next, static_cast<Time>(std::min<std::int64_t>(onward, kNever - 1))});
  index_.insert(left, static_cast<std::uint32_t>(stage));
  return stage;
}

}  // namespace grove::detail
