// SPDX-License-Identifier: MIT
#include "visit_states.h"

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

VisitStates::VisitStates(const Problem& problem, AgentIndex agent, Sequence order)
    : start_(problem.instance.agent(agent).start),
      destination_(problem.instance.agent(agent).goal),
      order_(std::move(order)) {
  const std::vector<TaskIndex>& tasks = problem.instance.agent(agent).tasks;
  if (!is_complete(order_, tasks.size()))
    throw std::invalid_argument("an order must hold every stop of its agent once");
  for (TaskIndex task : tasks) {
    cells_.push_back(problem.instance.task(task).cell);
    to_stop_.push_back(&problem.distances.to(cells_.back()));
  }
  to_rest_ = destination_ ? &problem.distances.to(*destination_) : to_stop_[order_.back()];
  all_ = make(tasks.size() == 64 ? ~StopSet{0} : (StopSet{1} << tasks.size()) - 1);
}

VisitStates::State VisitStates::make(StopSet left) {
  const DistanceField* to_next = to_rest_;
  std::int64_t onward = 0;
  Cell from = kNoCell;
  const auto go_on = [&](const DistanceField* to) {
    if (from == kNoCell)
      to_next = to;
    else
      onward += (*to)[from];
  };
  for (Stop stop : order_) {
    if ((left >> stop & 1) == 0) continue;
    go_on(to_stop_[stop]);
    from = cells_[stop];
  }
  go_on(to_rest_);
  const auto state = static_cast<State>(entries_.size());
  entries_.push_back(
      {left, to_next, static_cast<Time>(std::min<std::int64_t>(onward, kNever - 1))});
  index_.insert(left, static_cast<std::uint32_t>(state));
  return state;
}

}  // namespace grove
