// SPDX-License-Identifier: MIT
// Low level of Optimal-CBS (the first baseline of the paper, section V; "CBS + A*" in Tang et al.
// 2024): one A* over (cell, time, tasks left).
//
// A task is visited as soon as the agent is on it. This costs nothing and excludes no continuation,
// so the search stays exact. It remains to show:
//
// - *Heuristic.* If tasks are left, h is the distance to the nearest task left plus the weight of
//   the minimum spanning tree of all tasks left and the destination. It is a lower bound, because
//   the agent first goes to some task left and from there takes a path through all these goals. It
//   is consistent for two reasons. A step changes the distance by at most one. A visit of task i,
//   where the distance is 0, replaces the tree by the tree without i; with an edge from i to the
//   nearest task left, the new tree spans i again. If no task is left, h is the distance to the
//   destination or, if there is none, to the nearest own task.
// - *End.* The agent finishes on its destination or, if it has none, on any own task, if no
//   constraint forbids it to stay there forever.
// - *Finitely many states.* Once the constraints are constant, all times are one state, which keeps
//   the earliest time. The search can therefore prove that an agent has no path.
#include "baselines/visited_set_search.h"

#include <algorithm>

#include "baselines/space_time.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::int32_t kNoLabel = -1;

}  // namespace

PathOutcome VisitedSetSearch::search(const AgentStops& stops, const PathQuery& query,
                                     const Limits& limits, Path& path) {
  prepare(stops, query.constraints);
  if (slot_at(intervals_, stops.start(), 0) < 0) return PathOutcome::kInfeasible;
  reach(stops.start(), 0, stops.all(), kNoLabel);
  return run(query.cutoff, limits, path);
}

void VisitedSetSearch::prepare(const AgentStops& stops, std::span<const Constraint> constraints) {
  const AgentIndex agent = stops.agent();
  if (bounds_.size() <= static_cast<std::size_t>(agent)) bounds_.resize(agent + 1);
  if (!bounds_[agent]) bounds_[agent] = std::make_unique<SpanningTreeBound>(stops);
  stops_ = &stops;
  bound_ = bounds_[agent].get();
  intervals_.assign(constraints);
  static_from_ = static_from(constraints);
  sets_ = {};
  index_ = {};
  labels_.clear();
  queue_.reset(0);
}

PathOutcome VisitedSetSearch::run(Time cutoff, const Limits& limits, Path& path) {
  BucketQueue::Entry entry;
  while (queue_.pop(entry)) {
    const Label label = labels_[entry.slot];
    if (label.time != entry.time) continue;  // improved since
    if (queue_.layer() > cutoff) return PathOutcome::kAboveCutoff;
    if (is_finish(label)) {
      write_path(entry.slot, path);
      return PathOutcome::kFound;
    }
    if (++expanded_ % kExpansionsPerPoll == 0 && limits.stop_requested())
      return PathOutcome::kStopped;
    for_each_step(world_, intervals_, label.cell, label.time,
                  [&](Cell next) { reach(next, label.time + 1, label.left, entry.slot); });
  }
  return PathOutcome::kInfeasible;
}

void VisitedSetSearch::reach(Cell cell, Time time, StopSet left, std::int32_t parent) {
  if (const int stop = stops_->stop_at(cell); stop != AgentStops::kNoStop)
    left &= ~(StopSet{1} << stop);
  const std::uint64_t set = sets_.insert(left, static_cast<std::uint32_t>(labels_.size()));
  const auto row = static_cast<std::uint64_t>(std::min(time, static_from_));
  const auto rows = static_cast<std::uint64_t>(static_from_) + 1;
  const std::uint64_t key = (set * rows + row) * static_cast<std::uint64_t>(world_.place_count()) +
                            static_cast<std::uint64_t>(cell);
  const auto next = static_cast<std::uint32_t>(labels_.size());
  const std::uint32_t id = index_.insert(key, next);
  if (id != next) {
    if (labels_[id].time <= time) return;
    labels_[id].time = time;
    labels_[id].parent = parent;
  } else {
    labels_.push_back({left, time, cell, parent});
  }
  const Time onward = min_cost(cell, left);
  if (onward >= kNever) return;
  GROVE_ASSERT(time + onward >= queue_.layer(), "the estimate of a path never falls");
  queue_.push(std::max(queue_.layer(), time + onward),
              {.slot = static_cast<std::int32_t>(id), .time = time});
}

// Lower bound on the remaining cost from `cell` with the tasks `left`.
Time VisitedSetSearch::min_cost(Cell cell, StopSet left) {
  if (left == 0 && stops_->destination()) return stops_->to_rest(cell);
  Time nearest = kNever;
  for (int stop = 0; stop < stops_->count(); ++stop)
    if (left == 0 || (left >> stop & 1) != 0)
      nearest = std::min(nearest, stops_->distance(cell, stop));
  const Time tree = left == 0 ? 0 : (*bound_)(left, SpanningTreeBound::kNowhere);
  return nearest >= kNever || tree >= kNever ? kNever : nearest + tree;
}

bool VisitedSetSearch::is_finish(const Label& label) const {
  if (label.left != 0) return false;
  const bool on_goal = stops_->destination() ? label.cell == *stops_->destination()
                                             : stops_->stop_at(label.cell) != AgentStops::kNoStop;
  const int slot = slot_at(intervals_, label.cell, label.time);
  return on_goal && intervals_.may_rest(slot);
}

void VisitedSetSearch::write_path(std::int32_t finish, Path& path) const {
  path.resize(static_cast<std::size_t>(labels_[finish].time) + 1);
  for (std::int32_t id = finish; id != kNoLabel; id = labels_[id].parent) {
    GROVE_ASSERT(labels_[id].parent == kNoLabel
                     ? labels_[id].time == 0
                     : labels_[labels_[id].parent].time + 1 == labels_[id].time,
                 "a path has one label per step, from time 0 on");
    path[labels_[id].time] = labels_[id].cell;
  }
}

}  // namespace grove::detail
