// SPDX-License-Identifier: MIT
// A* over the visiting orders of one agent. A label is (goals left, goal on which the agent stands,
// safe interval in which it stands there), with the earliest known time. An edge is a leg; the leg
// planner returns its duration (legs.h). The heuristic is the weight of the minimum spanning tree
// of this goal and the goals left.
//
// *Source.* As published, the middle level of HCBS (Surynek, AAAI 2021) has one label per (goals
// left, goal) and uses each leg's earliest arrival. This is neither optimal nor complete: an agent
// that arrives early can be trapped by a constraint that begins later, while an agent that waits
// elsewhere and arrives later avoids it. Tang et al. (2024) observe this and make the goal's safe
// interval part of the label in their MGCBS. Here both methods are exact, use the labels of MGCBS,
// and differ only in the way in which legs are found.
//
// *Claim: one time per label is enough.* The agent can wait within a safe interval. After an
// earlier arrival and a wait it can therefore do whatever it can do after a later arrival.
//
// *Claim: it is enough to start each leg from a goal.* For each goal, take one moment at which the
// path is on it, and cut the path at these moments. Each piece is a leg between two goals. A leg
// may pass other goals; these are visited once more, or a different order counts them there. So the
// agent's best path is a sequence of legs, and every sequence of legs is a path.
//
// *End.* With a destination, the leg to it follows when no stop is left. Without one, the agent
// rests on a stop of its own, which is counted last. So the last goal must be reached in an
// interval in which the agent may stay forever. The other goals only have to be reached.
#include "baselines/visiting_order_search.h"

#include <algorithm>
#include <bit>
#include <new>
#include <utility>

#include "model/assert.h"

namespace grove::detail {

VisitingOrderSearch::VisitingOrderSearch(const World& world, std::unique_ptr<Legs> legs)
    : intervals_(world), legs_(std::move(legs)) {}

PathOutcome VisitingOrderSearch::search(const AgentStops& stops, const PathQuery& query,
                                        const Limits& limits, Path& path) {
  if (!prepare(stops, query.constraints)) return PathOutcome::kInfeasible;
  start();
  return run(query.cutoff, limits, path);
}

// Returns false if the start is forbidden at time 0, in which case there is no path.
bool VisitingOrderSearch::prepare(const AgentStops& stops,
                                  std::span<const Constraint> constraints) {
  stops_ = &stops;
  const AgentIndex agent = stops.agent();
  if (bounds_.size() <= static_cast<std::size_t>(agent)) bounds_.resize(agent + 1);
  if (!bounds_[agent]) bounds_[agent] = std::make_unique<SpanningTreeBound>(stops);
  intervals_.assign(constraints);
  const int start_slot = intervals_.start_slot(stops.start());
  if (start_slot < 0) return false;
  targets_.assign(1, {-1, start_slot});
  first_target_.clear();
  for (int stop = 0; stop < stops.count(); ++stop) add_targets(stop, stops.place(stop));
  if (stops.destination()) add_targets(stops.count(), *stops.destination());
  first_target_.push_back(columns());
  legs_->begin(stops, intervals_, constraints);
  return true;
}

void VisitingOrderSearch::add_targets(int goal, Cell cell) {
  first_target_.push_back(columns());
  for (int slot = intervals_.first_slot(cell); slot < intervals_.end_slot(cell); ++slot)
    targets_.push_back({goal, slot});
}

void VisitingOrderSearch::start() {
  rows_ = {};
  lefts_.clear();
  labels_.clear();
  const Time least = bound()(stops_->all(), SpanningTreeBound::kNowhere);
  queue_.reset(0);
  if (least >= kNever) return;
  const std::int32_t first = row_of(stops_->all());
  labels_[first * columns()].time = 0;
  queue_.push(0, {.slot = first * columns(), .time = 0});
}

std::int32_t VisitingOrderSearch::row_of(StopSet left) {
  const auto next = static_cast<std::uint32_t>(lefts_.size());
  const std::uint32_t row = rows_.insert(left, next);
  if (row == next) {
    if (labels_.size() + targets_.size() > kMaxLabels) throw std::bad_alloc();
    lefts_.push_back(left);
    labels_.resize(labels_.size() + targets_.size());
  }
  return static_cast<std::int32_t>(row);
}

PathOutcome VisitingOrderSearch::run(Time cutoff, const Limits& limits, Path& path) {
  Entry entry;
  while (queue_.pop(entry)) {
    if (labels_[entry.slot].time != entry.time) continue;  // improved since
    if (queue_.layer() > cutoff) return PathOutcome::kAboveCutoff;
    if (is_finish(entry.slot)) {
      write_path(entry.slot, path);
      return PathOutcome::kFound;
    }
    ++expanded_;
    expand(entry.slot, limits);
    if (limits.stop_requested()) return PathOutcome::kStopped;
  }
  return PathOutcome::kInfeasible;
}

bool VisitingOrderSearch::is_finish(std::int32_t id) const {
  const int goal = targets_[column_of(id)].goal;
  return left_of(id) == 0 && (stops_->destination() ? goal == stops_->count() : goal >= 0);
}

void VisitingOrderSearch::expand(std::int32_t id, const Limits& limits) {
  const StopSet left = left_of(id);
  const bool ends_anywhere = !stops_->destination();
  for (StopSet rest = left; rest != 0; rest &= rest - 1) {
    const int stop = std::countr_zero(rest);
    const StopSet then = left & ~(StopSet{1} << stop);
    go_to(stop, then, id, then == 0 && ends_anywhere, limits);
  }
  if (left == 0 && !ends_anywhere) go_to(stops_->count(), 0, id, true, limits);
}

// Adds the legs from label `from` to `goal`. `to_rest`: the goal is the last one.
void VisitingOrderSearch::go_to(int goal, StopSet left, std::int32_t from, bool to_rest,
                                const Limits& limits) {
  const std::int32_t row = row_of(left);
  const Time time = labels_[from].time;
  const Cell cell = cell_of(column_of(from));
  const Time onward = bound()(left, goal == stops_->count() ? SpanningTreeBound::kNowhere : goal);
  for (int column = first_target_[goal]; column < first_target_[goal + 1]; ++column) {
    const Legs::Target target = targets_[column];
    if (to_rest && !intervals_.may_rest(target.slot)) continue;
    const std::int32_t id = row * columns() + column;
    if (labels_[id].time <= time) continue;
    const Time arrival = legs_->arrival(cell, time, target, limits);
    if (arrival >= labels_[id].time) continue;
    GROVE_ASSERT(arrival + onward >= queue_.layer(), "the estimate of a path never falls");
    labels_[id] = {arrival, from};
    queue_.push(std::max(queue_.layer(), arrival + onward), {.slot = id, .time = arrival});
  }
}

void VisitingOrderSearch::write_path(std::int32_t finish, Path& path) {
  std::vector<std::int32_t> chain;
  for (std::int32_t id = finish; id != kNoLabel; id = labels_[id].parent) chain.push_back(id);
  std::ranges::reverse(chain);
  path.assign(1, stops_->start());
  for (std::size_t i = 1; i < chain.size(); ++i)
    legs_->append(path.back(), labels_[chain[i - 1]].time, targets_[column_of(chain[i])], path);
  GROVE_CHECK(std::ssize(path) == labels_[finish].time + 1,
              "the legs of a path take the time of its label");
}

}  // namespace grove::detail
