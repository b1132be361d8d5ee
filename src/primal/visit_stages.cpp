// SPDX-License-Identifier: MIT
#include "visit_stages.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace grove {
namespace {

bool is_complete(Sequence order, std::size_t stops) {
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != i) return false;
  return order.size() == stops;
}

}  // namespace

VisitStages::VisitStages(const Problem& problem, AgentIndex agent, Sequence order)
    : world_(problem.instance.world()),
      start_(problem.instance.agent(agent).start),
      destination_(problem.instance.agent(agent).goal),
      order_(std::move(order)) {
  const std::vector<TaskIndex>& tasks = problem.instance.agent(agent).tasks;
  if (!is_complete(order_, tasks.size()))
    throw std::invalid_argument("an order must hold every stop of its agent once");
  for (TaskIndex task : tasks) {
    places_.push_back(problem.instance.task(task).cell);
    to_stop_.push_back(&problem.distances.to(places_.back()));
  }
  to_rest_ = destination_ ? &problem.distances.to(*destination_) : to_stop_[order_.back()];
  all_ = make(tasks.size() == 64 ? ~StopSet{0} : (StopSet{1} << tasks.size()) - 1);
}

VisitStages::Stage VisitStages::make(StopSet left) {
  const DistanceField* to_next = to_rest_;
  std::int64_t onward = 0;
  Place from = kNoPlace;
  const auto go_on = [&](const DistanceField* to) {
    if (from == kNoPlace)
      to_next = to;
    else
      onward += (*to)[from];
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

}  // namespace grove
