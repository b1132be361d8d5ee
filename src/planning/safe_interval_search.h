// SPDX-License-Identifier: MIT
// The core of both low levels: A* over safe intervals (SIPP: Phillips and Likhachev, ICRA 2011)
// with what has been visited as part of the state (as in the multi-label A* of Grenouilleau, van
// Hoeve and Hooker, ICAPS 2019). What there is to visit, and so what is dropped and what is put
// off, is the affair of the goals: goals_in_turn.h, goals_in_class.h.
//
// Labels and dominance. A *label* is a (state, safe interval of its place, progress), progress
// being a number for what is visited; it keeps the earliest time known to reach it. That is enough:
// constraints bar places and moves between them, never waits, so an agent there at time t can be
// there at any later time of the interval, waiting changes no progress, and whatever a later
// arrival can do, an earlier one can do after waiting. A barred move (edge constraint) delays a
// departure, and departing later is again open to the earlier arrival. Into each safe interval of a
// neighbor only the earliest permitted arrival is generated, for the same reason. Nothing of this
// holds across intervals: arriving early can mean being caught in an interval that leads nowhere,
// so labels of different intervals never dominate each other. (A chain that may not be traversed
// gives its inner places several copies of each interval, by the end the agent came in at, and a
// place that may not be rested on by some time two intervals, by the time of arrival:
// safe_intervals.h. That is all of the past that a future can depend on.)
//
// The end. The agent may come to rest only where nothing bars it for ever after, with all goals
// visited. Such a label is a *finish*. No path costs less than the first rest, the least begin of
// such an interval, so a finish at that very time is optimal at once, whatever f the search has
// come to; that is what a raised heuristic, max(t + h, first rest), gives, without its plateau.
//
// Order. Labels come out by layers, f = t + h (or as the goals say), and may be put off to a later
// layer when their turn comes: the goals know why that loses no path. So a label may be improved
// after it was expanded; it is then expanded again. Its old children keep it as their parent:
// waiting there a little longer is permitted. Times only fall and postponements only rise, each
// through finitely many values: the search ends, and with an empty queue it has seen all that the
// goals did not drop.
//
// Ties. Among equal f fewer conflicts come first, and the finish is accepted when it comes out.
// (Conflicts while resting are the same for all paths of equal cost that rest on one place.) Every
// path that costs what an empty grid would cost passes its labels at their earliest times, so among
// these the result has the fewest conflicts possible. When constraints delay the agent, fewer
// conflicts are preferred but not searched for: that would need labels for later arrivals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "model/limits.h"
#include "planning/bucket_queue.h"
#include "planning/label_planes.h"
#include "planning/path_query.h"
#include "planning/safe_intervals.h"

namespace grove::detail {

// In place of a layer: the label is not needed.
inline constexpr Time kDropped = std::numeric_limits<Time>::max();

// `Goals` has a type Progress and says
//
// - on_arrival(progress, state, reach): calls reach(p) for each progress p that an agent of this
//   progress may be of once it has come to the state;
// - layer(progress, state, time): in which layer such a label is to come out, or kDropped;
// - may_end(progress, state): is this a finish, if the agent may rest here for ever?
// - first_rest(): no path costs less;
// - put_off(progress, state, time, layer): the layer to which such a label is put off, or kDropped;
//   `layer` or less: it is its turn;
// - makes_gate(state, before, progress): may a label whose parent is of progress `before` stand for
//   others?
// - close_gate(state, before, progress, time, until): it does, from `time` to before `until`.
template <class Goals>
class SafeIntervalSearch {
 public:
  using Progress = typename Goals::Progress;
  enum class End : std::uint8_t {
    kFound,
    kExhausted,  // there is no path but by labels that the goals dropped
    kPaused,     // so many labels are expanded; run() goes on
    kStopped,    // a limit struck
  };

  // `world` must outlive this.
  explicit SafeIntervalSearch(const World& world) : world_(world), intervals_(world) {}

  // To be set before begin(), and to stay as they are while the search runs.
  SafeIntervals& intervals() { return intervals_; }
  Goals& goals() { return goals_; }
  const World& world() const { return world_; }

  // The agent is in `start` at time 0 and of this progress before anything is visited there. No
  // label comes before `first_layer`. `others` may be null; it and `limits` must outlive this
  // search.
  void begin(State start, Progress progress, Time first_layer, const ConflictAvoidanceTable* others,
             const Limits& limits);
  // Continues until exactly so many labels are expanded in all: what is done by then must not
  // depend on the searches before.
  End run(std::int64_t pause_at);
  // Of what was found.
  Time cost() const { return finish_.time; }
  void write_path(Path& path);

  // Labels expanded by all searches so far, and with so many more.
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
  static constexpr std::int64_t kLabelsPerPoll = 256;  // of limits

  Label& label(const Entry& entry) { return planes_.label(entry.slot, entry.progress); }
  bool postpone(const Entry& entry, State state);
  void close_gate(const Entry& entry, State state, Progress before);
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
    if (l.time != entry.time || l.conflicts != entry.conflicts) continue;  // improved since
    const State state = intervals_.state_of(entry.slot);
    if (postpone(entry, state)) continue;
    if (is_finish(entry.slot, state, entry.progress)) {
      finish_ = entry;
      return planes_.exhausted() ? End::kStopped : End::kFound;
    }
    close_gate(entry, state, l.parent_progress);
    expand(entry, state);
    ++expanded_;
    if (expanded_ % kLabelsPerPoll == 0 && limits_->stop_requested()) return End::kStopped;
    if (expanded_ >= pause_at) return End::kPaused;
  }
  return planes_.exhausted() ? End::kStopped : End::kExhausted;
}

template <class Goals>
bool SafeIntervalSearch<Goals>::postpone(const Entry& entry, State state) {
  const Time layer = goals_.put_off(entry.progress, state, entry.time, queue_.layer());
  if (layer <= queue_.layer()) return false;
  if (layer != kDropped) queue_.push(layer, entry);
  return true;
}

// A gate must leave open what those that it stands for do next.
template <class Goals>
void SafeIntervalSearch<Goals>::close_gate(const Entry& entry, State state, Progress before) {
  if (goals_.makes_gate(state, before, entry.progress) && intervals_.stands_for_others(entry.slot))
    goals_.close_gate(state, before, entry.progress, entry.time, intervals_.next_begin(entry.slot));
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
  // No path is cheaper than a finish at the first rest: it need not wait for its layer.
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
  return static_cast<std::uint16_t>(std::min<int>(count, Queue::kMostConflicts));
}

template <class Goals>
void SafeIntervalSearch<Goals>::write_path(Path& path) {
  Entry at = finish_;
  Time end = at.time;
  path.resize(static_cast<std::size_t>(end) + 1);
  while (at.slot != kNoSlot) {
    const Label& l = label(at);
    std::fill(path.begin() + l.time, path.begin() + end + 1, intervals_.state_of(at.slot));
    end = l.time - 1;
    at.slot = l.parent_slot;
    at.progress = l.parent_progress;
  }
}

}  // namespace grove::detail
