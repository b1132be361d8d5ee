// SPDX-License-Identifier: MIT
// Space-time A* for one leg, over (cell, time). Once the constraints are constant, all times are
// one state, which keeps the earliest time. The space is therefore finite, and the search can prove
// that a leg does not exist. f = max(time + distance, start of the target's interval), which is
// consistent.
#include "baselines/space_time_legs.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include "baselines/space_time.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::int32_t kNone = -1;

}  // namespace

void SpaceTimeLegs::begin(const AgentStops& stops, const SafeIntervals& intervals,
                          std::span<const Constraint> constraints) {
  stops_ = &stops;
  intervals_ = &intervals;
  static_from_ = static_from(constraints);
}

Time SpaceTimeLegs::arrival(Cell from, Time time, Target target, const Limits& limits) {
  const std::int32_t end = find(from, time, target, limits);
  return end == kNone ? kNever : labels_[end].time;
}

void SpaceTimeLegs::append(Cell from, Time time, Target target, Path& path) {
  std::int32_t id = find(from, time, target, Limits());
  if (id == kNone) throw std::logic_error("internal error: a leg that was found is missing");
  const Time end = labels_[id].time;
  const std::size_t before = path.size();
  path.resize(before + static_cast<std::size_t>(end - time));
  for (; id != kNone; id = labels_[id].parent) {
    GROVE_ASSERT(
        labels_[id].time == time || labels_[labels_[id].parent].time + 1 == labels_[id].time,
        "a leg has one label per step");
    if (labels_[id].time > time)
      path[before + static_cast<std::size_t>(labels_[id].time - time) - 1] = cell_of(id);
  }
}

// Returns the label of the earliest arrival in the target, or kNone if there is none or a limit was
// reached.
std::int32_t SpaceTimeLegs::find(Cell from, Time time, Target target, const Limits& limits) {
  forget();
  first_ = std::min(time, static_from_);
  const auto rows = static_cast<std::size_t>(static_from_ - first_) + 1;
  const std::size_t needed = rows * static_cast<std::size_t>(world_.place_count());
  if (needed > kMaxLabels) throw std::bad_alloc();
  if (labels_.size() < needed) labels_.resize(needed);
  queue_.reset(time);
  reach(from, time, kNone, target);
  const Cell goal = intervals_->state_of(target.slot);
  const Time begin = intervals_->begin_of(target.slot);
  const Time end = intervals_->end_of(target.slot);
  BucketQueue::Entry entry;
  while (queue_.pop(entry)) {
    const std::int32_t id = entry.slot;
    const Cell cell = cell_of(id);
    if (labels_[id].time != entry.time) continue;  // improved since
    if (queue_.layer() > end) return kNone;
    if (cell == goal && entry.time >= begin) return id;
    if (++expanded_ % kExpansionsPerPoll == 0 && limits.stop_requested()) return kNone;
    for_each_step(world_, *intervals_, cell, entry.time,
                  [&](Cell next) { reach(next, entry.time + 1, id, target); });
  }
  return kNone;
}

void SpaceTimeLegs::forget() {
  if (++stamp_ != 0) return;
  std::ranges::fill(labels_, Label{});
  stamp_ = 1;
}

void SpaceTimeLegs::reach(Cell cell, Time time, std::int32_t parent, Target target) {
  const std::int32_t id = id_of(cell, time);
  Label& label = labels_[id];
  if (label.stamp == stamp_ && label.time <= time) return;
  const Time to_goal = distance(cell, target.goal);
  if (to_goal >= kNever) return;
  label = {time, parent, stamp_};
  const Time f = std::max(time + to_goal, intervals_->begin_of(target.slot));
  GROVE_ASSERT(f >= queue_.layer(), "the estimate of a leg never falls");
  queue_.push(std::max(f, queue_.layer()), {.slot = id, .time = time});
}

Time SpaceTimeLegs::distance(Cell cell, int goal) const {
  return goal == stops_->count() ? stops_->to_rest(cell) : stops_->distance(cell, goal);
}

}  // namespace grove::detail
