// SPDX-License-Identifier: MIT
// Safe-interval search, the core of both low levels: A* over safe intervals (SIPP: Phillips and
// Likhachev, ICRA 2011) with the visited goals as part of the search state (as in the multi-label
// A* of Grenouilleau, van Hoeve and Hooker, ICAPS 2019). The template parameter Goals defines the
// goals, and hence which labels are dropped or postponed (fixed_order_goals.h, free_order_goals.h).
//
// *Labels and dominance.* A *label* is a (state, safe interval of its place, progress), where
// progress identifies the set of visited goals. It stores the earliest known time of arrival.
// *Claim: the earliest time suffices.* *Proof.* Constraints bar places and moves between them,
// never waits, so an agent that is there at time t can be there at any later time of the interval.
// Waiting changes no progress. Therefore an agent that arrives earlier can wait and then continue
// like one that arrives later. A barred move (edge constraint) only delays a departure, and an
// agent that arrived earlier can also make the later departure. For the same reason only the
// earliest permitted arrival in each safe interval of a neighbor is generated. The claim does not
// hold across intervals, because an agent that arrives early can be caught in an interval that
// leads nowhere. So labels of different intervals never dominate each other. (If traversals of a
// corridor are barred, its inner places have several copies of each interval, which differ in where
// the agent entered. If an agent may not rest on a place by some time, the place has two intervals,
// which differ in the time of arrival; see safe_intervals.h. The continuations depend on no other
// part of the past.)
//
// *Finish.* The agent may come to rest only after all goals are visited and in an interval that
// permits rest. A label with both properties is a *finish*. The *first rest* is the earliest start
// of an interval in which the agent may rest. No path costs less, so a finish at that time is
// optimal, no matter which f the search has reached. The raised heuristic max(t + h, first rest)
// would have the same effect, but with a plateau.
//
// *Order.* Labels are popped by layer, which is f = t + h unless Goals defines another value. When
// a label is popped, it can be postponed to a later layer; Goals has the proof that this loses no
// path. As a result, a label can be improved after its expansion, and is then expanded again. Its
// old children keep it as their parent, because the agent may wait there longer. *Termination.*
// Times only decrease and postponements only increase, each through finitely many values. If the
// queue is empty, the search has covered everything that Goals did not drop.
//
// *Ties.* Among labels of equal f, those with fewer conflicts are popped first, and a finish is
// accepted when it is popped. (Conflicts during the final rest are equal for all paths of equal
// cost that rest on one place.) A path that costs no more than the optimum without constraints
// passes its labels at their earliest times. So among these paths the search finds one with the
// fewest conflicts, where counts above BucketQueue::kMaxConflicts are equal. If constraints delay
// the agent, the search prefers few conflicts but does not minimize them, because that would
// require labels for later arrivals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "model/assert.h"
#include "model/limits.h"
#include "planning/agent_planner.h"
#include "planning/bucket_queue.h"
#include "planning/label_planes.h"
#include "planning/safe_intervals.h"

namespace grove::detail {

// Value in place of a layer: the label is not needed.
inline constexpr Time kDropped = std::numeric_limits<Time>::max();

// Safe-interval search. `Goals` has a type Progress and the functions
//
// - on_arrival(progress, state, reach): calls reach(p) for each progress p that an agent can have
//   after it arrives in the state with `progress`;
// - layer(progress, state, time): the layer in which this label is to be popped, or kDropped;
// - may_end(progress, state): are all goals visited, and is this a state of rest? (The search tests
//   the interval itself.)
// - first_rest(): lower bound on the cost of every path;
// - postponed_layer(progress, state, time, layer): the layer to which this label, popped in
//   `layer`, is postponed, or kDropped; a value of at most `layer` if it is not postponed;
// - can_be_gate(state, before, progress): can a label in `state` whose parent has progress `before`
//   be a *gate*, i.e. dominate other labels?
// - add_gate(state, before, progress, time, until): records a gate that dominates labels from
//   `time` on and before `until`.
template <class Goals>
class SafeIntervalSearch {
 public:
  using Progress = typename Goals::Progress;
  enum class End : std::uint8_t {
    kFound,
    kExhausted,  // no path exists except through labels that Goals dropped
    kPaused,     // expanded() has reached `pause_at`; call run() to continue
    kStopped,    // a limit was reached, or there was no memory for labels
  };

  // `world` must outlive this object.
  explicit SafeIntervalSearch(const World& world) : world_(world), intervals_(world) {}

  // Set the intervals and the goals before begin(), and do not change them while the search runs.
  SafeIntervals& intervals() { return intervals_; }
  Goals& goals() { return goals_; }
  const World& world() const { return world_; }

  // Starts a search. The agent is in `start` at time 0; `progress` is its progress before it visits
  // goals there. No label has a layer below `first_layer`. `others` may be nullptr. `others` and
  // `limits` must outlive this search.
  void begin(State start, Progress progress, Time first_layer, const ConflictAvoidanceTable* others,
             const Limits& limits);
  // Continues until the search ends or expanded(), which counts all searches, is exactly
  // `pause_at`. (If it is at least `pause_at` already, expands one more label.) The count is exact
  // so that the effort of a search does not depend on earlier searches.
  End run(std::int64_t pause_at);
  // The cost of the path found, and the path. Valid after kFound.
  Time cost() const { return finish_.time; }
  void write_path(Path& path);

  // Labels expanded by all searches so far, and that number plus `more`, at most
  // PathQuery::kUnlimited.
  std::int64_t expanded() const { return expanded_; }
  std::int64_t expanded_after(std::int64_t more) const {
    return more < PathQuery::kUnlimited - expanded_ ? expanded_ + more : PathQuery::kUnlimited;
  }

 private:
  using Queue = BasicBucketQueue<Progress>;
  using Entry = typename Queue::Entry;

  struct Label {
    Time time;
    std::int32_t parent_slot;
    std::uint32_t stamp;
    std::uint16_t conflicts;
    Progress parent_progress;
  };

  static constexpr std::int32_t kNoSlot = -1;
  static constexpr std::int64_t kLabelsPerPoll = 256;  // labels between polls of the limits

  Label& label(const Entry& entry) { return planes_.label(entry.slot, entry.progress); }
  bool postpone(const Entry& entry, State state);
  void add_gate(const Entry& entry, State state, Progress before);
  void expand(const Entry& entry, State state);
  void reach(const Entry& from, State from_state, std::int32_t slot, State state, Time time,
             Progress progress);
  bool is_finish(std::int32_t slot, State state, Progress progress) const {
    return goals_.may_end(progress, state) && intervals_.may_rest(slot);
  }
  std::uint16_t conflicts_on_arrival(const Entry& from, Place from_place, Place place,
                                     Time time) const;

  const World& world_;
  SafeIntervals intervals_;
  Goals goals_;
  Queue queue_;
  LabelPlanes<Label> planes_;
  const ConflictAvoidanceTable* others_ = nullptr;
  const Limits* limits_ = nullptr;
  Entry finish_;
  std::int64_t expanded_ = 0;
};

template <class Goals>
void SafeIntervalSearch<Goals>::begin(State start, Progress progress, Time first_layer,
                                      const ConflictAvoidanceTable* others, const Limits& limits) {
  others_ = others;
  limits_ = &limits;
  planes_.begin_search(intervals_.slot_limit());
  queue_.reset(first_layer);
  const int slot = intervals_.start_slot(start);
  if (slot == kNoSlot) return;
  goals_.on_arrival(progress, start, [&](Progress p) {
    if (planes_.open(p, limits))
      reach({.slot = kNoSlot, .time = -1, .progress = p}, start, slot, start, 0, p);
  });
}

template <class Goals>
typename SafeIntervalSearch<Goals>::End SafeIntervalSearch<Goals>::run(std::int64_t pause_at) {
  for (Entry entry; queue_.pop(entry);) {
    const Label& l = label(entry);
    if (l.time != entry.time || l.conflicts != entry.conflicts) continue;  // was improved later
    const State state = intervals_.state_of(entry.slot);
    if (postpone(entry, state)) continue;
    if (is_finish(entry.slot, state, entry.progress)) {
      finish_ = entry;
      return planes_.exhausted() ? End::kStopped : End::kFound;
    }
    add_gate(entry, state, l.parent_progress);
    expand(entry, state);
    ++expanded_;
    if (expanded_ % kLabelsPerPoll == 0 && limits_->stop_requested()) return End::kStopped;
    if (expanded_ >= pause_at) return End::kPaused;
  }
  return planes_.exhausted() ? End::kStopped : End::kExhausted;
}

template <class Goals>
bool SafeIntervalSearch<Goals>::postpone(const Entry& entry, State state) {
  const Time layer = goals_.postponed_layer(entry.progress, state, entry.time, queue_.layer());
  if (layer <= queue_.layer()) return false;
  if (layer != kDropped) queue_.push(layer, entry);
  return true;
}

// A label can be a gate only if its agent can make all continuations of the labels that it
// dominates.
template <class Goals>
void SafeIntervalSearch<Goals>::add_gate(const Entry& entry, State state, Progress before) {
  if (goals_.can_be_gate(state, before, entry.progress) && intervals_.may_dominate(entry.slot))
    goals_.add_gate(state, before, entry.progress, entry.time, intervals_.next_begin(entry.slot));
}

template <class Goals>
void SafeIntervalSearch<Goals>::expand(const Entry& entry, State from) {
  intervals_.for_each_move(entry.slot, entry.time, [&](int slot, State state, Time time) {
    goals_.on_arrival(entry.progress, state,
                      [&](Progress progress) { reach(entry, from, slot, state, time, progress); });
  });
}

template <class Goals>
void SafeIntervalSearch<Goals>::reach(const Entry& from, State from_state, std::int32_t slot,
                                      State state, Time time, Progress progress) {
  if (progress != from.progress && !planes_.open(progress, *limits_)) return;
  Label& l = planes_.label(slot, progress);
  const bool known = planes_.is_current(l);
  if (known && (l.time < time || (l.time == time && l.conflicts <= from.conflicts))) return;
  const Time layer = goals_.layer(progress, state, time);
  if (layer == kDropped) return;
  GROVE_ASSERT(
      layer >= time && time >= intervals_.begin_of(slot) && time <= intervals_.end_of(slot),
      "a label is in its interval, and its layer is no less than its time");
  const std::uint16_t conflicts =
      others_ && time > 0
          ? conflicts_on_arrival(from, world_.place(from_state), world_.place(state), time)
          : std::uint16_t{0};
  if (known && l.time == time && l.conflicts <= conflicts) return;

  l = {.time = time,
       .parent_slot = from.slot,
       .stamp = planes_.stamp(),
       .conflicts = conflicts,
       .parent_progress = from.progress};
  // No path costs less than a finish at the first rest, so this finish goes to the current layer.
  const bool optimal = time == goals_.first_rest() && is_finish(slot, state, progress);
  queue_.push(optimal ? queue_.layer() : std::max(layer, queue_.layer()),
              {.slot = slot, .time = time, .conflicts = conflicts, .progress = progress});
}

template <class Goals>
std::uint16_t SafeIntervalSearch<Goals>::conflicts_on_arrival(const Entry& from, Place from_place,
                                                              Place place, Time time) const {
  int count = from.conflicts + others_->conflicts(from_place, place, time);
  if (time > from.time + 1)
    count += others_->conflicts_of_waiting(from_place, from.time + 1, time - 1);
  return static_cast<std::uint16_t>(std::min<int>(count, Queue::kMaxConflicts));
}

template <class Goals>
void SafeIntervalSearch<Goals>::write_path(Path& path) {
  Entry at = finish_;
  Time end = at.time;
  path.resize(static_cast<std::size_t>(end) + 1);
  while (at.slot != kNoSlot) {
    const Label& l = label(at);
    GROVE_ASSERT(l.time <= end, "labels along a path are in order of time");
    std::fill(path.begin() + l.time, path.begin() + end + 1, intervals_.state_of(at.slot));
    end = l.time - 1;
    at.slot = l.parent_slot;
    at.progress = l.parent_progress;
  }
  GROVE_ASSERT(end == -1, "a path begins at time 0");
}

}  // namespace grove::detail
