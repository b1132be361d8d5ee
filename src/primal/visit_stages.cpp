// SPDX-License-Identifier: MIT
#include "primal/visit_stages.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

bool is_complete(Sequence order, std::size_t stops) {
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != i) return false;
  return order.size() == stops;
}

}  // namespace

VisitStages::VisitStages(const Problem& problem, AgentIndex agent, Sequence order,
                         const LegFields* guide)
    : instance_(problem.instance),
      agent_(agent),
      start_(problem.instance.agent(agent).start),
      order_(std::move(order)) {
  if (!is_complete(order_, stops().size()))
    throw std::invalid_argument("an order must hold every stop of its agent once");
  for (const TaskIndex task : stops()) {
    places_.push_back(instance_.task(task).cell);
    steps_.to_stop.push_back(problem.distances.to_task(task));
    if (guide) guide_targets_.to_stop.push_back(guide->to_task[task]);
  }
  const bool on_last_stop = instance_.rests_on_last_stop(agent);
  steps_.to_rest = on_last_stop ? steps_.to_stop[order_.back()] : problem.distances.to_rest(agent);
  if (guide)
    guide_targets_.to_rest =
        on_last_stop ? guide_targets_.to_stop[order_.back()] : guide->to_rest[agent];
  else
    guide_targets_ = steps_;
  all_ = make(all_stops(static_cast<int>(stops().size())));
}

void VisitStages::go_by_steps() {
  guide_targets_ = steps_;
  for (Entry& known : entries_) known = entry(known.left);
}

VisitStages::Stage VisitStages::make(StopSet left) {
  GROVE_ASSERT(index_.find(left) == StopSetIndex::kAbsent, "a set of stops has one stage");
  const auto stage = static_cast<Stage>(entries_.size());
  entries_.push_back(entry(left));
  index_.insert(left, static_cast<std::uint32_t>(stage));
  return stage;
}

VisitStages::Entry VisitStages::entry(StopSet left) const {
  DistanceView to_next = guide_targets_.to_rest;
  std::int64_t onward = 0;
  Place from = kNoPlace;
  const auto extend_to = [&](DistanceView to) {
    if (from == kNoPlace)
      to_next = to;
    else
      onward += min_distance_from(instance_.world(), from, instance_.agent(agent_).kind, to);
  };
  for (Stop stop : order_) {
    if ((left >> stop & 1) == 0) continue;
    extend_to(guide_targets_.to_stop[stop]);
    from = places_[stop];
  }
  extend_to(guide_targets_.to_rest);
  return {left, to_next, static_cast<Time>(std::min<std::int64_t>(onward, kNever - 1))};
}

}  // namespace grove::detail
