// SPDX-License-Identifier: MIT
// The low level of CBS for an agent with several goals in a fixed order: A* over safe intervals
// (SIPP: Phillips and Likhachev, ICRA 2011) with the goals visited as part of the state (as in the
// multi-label A* of Grenouilleau, van Hoeve and Hooker, ICAPS 2019).
//
// States and dominance. A *label* is a (cell, safe interval, progress), progress being the number
// of goals visited, the last one not counted; it keeps the earliest time known to reach it. That
// is enough: constraints bar cells and moves, never waits, so an agent there at time t can be
// there at any later time of the interval, and whatever a later arrival can do, an earlier one can
// do after waiting. A barred move (edge constraint) delays a departure, and departing later is
// again open to the earlier arrival. Into each safe interval of a neighbor only the earliest
// permitted arrival is generated, for the same reason. Nothing of this holds across intervals:
// arriving early can mean being caught in an interval that leads nowhere, so labels of different
// intervals never dominate each other.
//
// Progress. Standing on the next goal counts as visiting it whenever it happens (at time 0 too,
// and again if the goal after it is the same cell): visits are free and having made one takes away
// no continuation. One path through all goals is planned as one path. Planning leg after leg with
// the earliest arrival of each is neither optimal nor complete.
//
// The end. The agent may come to rest only where nothing bars it for ever after: in a safe interval
// of the last goal that never ends and that one may rest in (kNoRestBy: it is split by the time of
// arrival, see safe_intervals.h), with all other goals visited. Such a label is a *finish*; without
// such an interval there is no path. f = t + h, where h = GoalSequence::distance
// is exact without constraints, so consistent. No path costs less than the begin of that interval,
// so a finish at that very time is optimal at once, whatever f the search has come to; that is what
// a raised heuristic, max(t + h, begin), would give, without its plateau.
//
// Two more prunes, both by the order of goals that every path must keep:
//
// - *Deadlines.* If goal k is barred for ever after time d, a label of progress p <= k is of use
//   only if t + (distance on through goal k) <= d, that is f <= d + after_goal(k). The smallest
//   right side over all k >= p is latest_[p]. That the agent must rest by t (kRestBy) is such a
//   deadline of the last goal.
//
// - *Gates.* Let G be a label of goal k just visited, in interval [a, b], reached at time g, and L
//   a label that has yet to visit goal k and cannot do so before g: f(L) >= g + after_goal(k). A
//   path P through L that visits goal k at some time <= b does so at a time in [g, b], where G
//   could stand as well, waiting: from there on P is open to G. Only paths that visit goal k in a
//   later interval, which begins at n, need L, and they cost n + after_goal(k) or more. So L is
//   postponed to that f, and dropped when there is no later interval. Soundness: as long as the
//   finish has not been taken out, some optimal path has an open label that is no later than it
//   on one of its states and has a key (the f it is queued under) of at most the optimal cost. If
//   L is that label and is postponed beyond the optimal cost, then P changes over to G as above:
//   the path through G costs the same, and the first label on it that is not yet expanded has more
//   progress than L had, so this ends. With unconstrained goals (b = kNever) the search thus
//   falls into legs by itself, and it is still exact when it must not.
//
//   A chain that may not be traversed (kNoTraversal) gives its inner cells several copies of each
//   interval, by the end the agent came in at. For G to stand where P does is of use only if G may
//   leave as P does: only a label in the free copy closes a gate.
//
// Postponing makes f come out of order, so a label may be improved after it was expanded; it is
// then expanded again. Its old children keep it as their parent: waiting there a little longer is
// permitted. Times only fall and postponements only rise, each through finitely many values:
// the search ends, and with an empty queue it has proven that there is no path.
//
// Ties. Among equal f fewer conflicts come first, and the finish is accepted when it comes out.
// (Conflicts while resting are the same for all paths of equal cost: they rest on one cell.)
// Every path that costs what an empty grid would cost passes its labels at their earliest times,
// so among these the result has the fewest conflicts possible. When constraints delay the agent,
// fewer conflicts are preferred but not searched for: that would need labels for later arrivals.
//
// Data. Labels lie in one flat array, progress by progress, stamped with the number of the call
// that wrote them: nothing is cleared between calls.
#include "grove/planning/low_level_search.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "grove/planning/bucket_queue.h"
#include "grove/planning/poll.h"
#include "grove/planning/safe_intervals.h"

namespace grove {
namespace {

constexpr int kMostGoals = 255;  // progress fits into a byte

}  // namespace

class LowLevelSearch::Workspace {
 public:
  explicit Workspace(const Grid& grid) : grid_(grid), intervals_(grid) {}

  Outcome find(const GoalSequence& goals, std::span<const Constraint> constraints,
               const ConflictAvoidanceTable* others, const Limits& limits, Path& path);
  std::int64_t expanded() const { return expanded_; }

 private:
  using Entry = BucketQueue::Entry;

  struct Label {
    Time time = 0;
    std::int32_t parent_slot = kNoSlot;
    std::uint32_t stamp = 0;
    std::uint16_t conflicts = 0;
    std::uint8_t parent_progress = 0;
  };

  // What the search knows of one progress value.
  struct Stage {
    const Time* to_goal;  // distance field of the next goal
    Time after_goal;
    Cell next_goal;  // to advance at; kNoCell at the last goal, where more is asked
    Time latest;     // labels of greater f miss a deadline
    // A label of f >= gate_from need not be looked at before gate_until.
    Time gate_from;
    Time gate_until;
  };

  static constexpr std::int32_t kNoSlot = -1;

  bool prepare(const GoalSequence& goals, std::span<const Constraint> constraints);
  void prepare_stages(const GoalSequence& goals);
  bool reserve_labels(const Limits& limits);
  void start(Cell cell);
  Outcome run(const Limits& limits, Path& path);

  Time f_of(Cell cell, int progress, Time time) const {
    return time + stages_[progress].to_goal[cell] + stages_[progress].after_goal;
  }
  Label& label(std::int32_t slot, int progress) {
    return labels_[static_cast<std::size_t>(progress) * slots_ + static_cast<std::size_t>(slot)];
  }
  bool is_finish(std::int32_t slot, int progress) const {
    return progress == last_progress_ && intervals_.cell_of(slot) == last_goal_ &&
           intervals_.may_rest(slot);
  }
  int advance(Cell cell, int progress) const {
    while (stages_[progress].next_goal == cell) ++progress;
    return progress;
  }

  bool is_stale(const Entry& entry);
  bool postpone(const Entry& entry);
  void close_gate(const Entry& entry);
  void expand(const Entry& entry);
  void arrive(const Entry& from, Cell from_cell, std::int32_t slot, Cell cell, Time time);
  std::uint16_t conflicts_on_arrival(const Entry& from, Cell from_cell, Cell cell, Time time) const;
  void write_path(const Entry& finish, Path& path);

  const Grid& grid_;
  SafeIntervals intervals_;
  BucketQueue queue_;
  std::vector<Stage> stages_;
  std::vector<Label> labels_;  // by progress, then slot
  std::uint32_t stamp_ = 0;
  std::size_t slots_ = 0;
  std::int64_t expanded_ = 0;

  // Of the call under way.
  const ConflictAvoidanceTable* others_ = nullptr;
  int last_progress_ = 0;
  Cell last_goal_ = kNoCell;
  Time finish_begin_ = 0;  // no path costs less
};

LowLevelSearch::LowLevelSearch(const Grid& grid) : workspace_(std::make_unique<Workspace>(grid)) {}
LowLevelSearch::~LowLevelSearch() = default;

LowLevelSearch::Outcome LowLevelSearch::find(const GoalSequence& goals,
                                             std::span<const Constraint> constraints,
                                             const ConflictAvoidanceTable* others,
                                             const Limits& limits, Path& path) {
  return workspace_->find(goals, constraints, others, limits, path);
}

std::int64_t LowLevelSearch::expanded() const {
  return workspace_->expanded();
}

LowLevelSearch::Outcome LowLevelSearch::Workspace::find(const GoalSequence& goals,
                                                        std::span<const Constraint> constraints,
                                                        const ConflictAvoidanceTable* others,
                                                        const Limits& limits, Path& path) {
  if (goals.size() > kMostGoals) throw std::invalid_argument("an agent may have 255 goals at most");
  if (limits.stop_requested()) return Outcome::kStopped;
  others_ = others;
  if (!prepare(goals, constraints)) return Outcome::kInfeasible;
  if (!reserve_labels(limits)) return Outcome::kStopped;
  start(goals.start());
  return run(limits, path);
}

// False when there is plainly no path.
bool LowLevelSearch::Workspace::prepare(const GoalSequence& goals,
                                        std::span<const Constraint> constraints) {
  intervals_.assign(constraints);
  slots_ = static_cast<std::size_t>(intervals_.slot_count());
  last_progress_ = goals.size() - 1;
  last_goal_ = goals.last();
  finish_begin_ = intervals_.rest_begin(last_goal_);
  if (finish_begin_ >= kNever || goals.distance(goals.start(), 0) >= kNever) return false;
  prepare_stages(goals);
  return true;
}

void LowLevelSearch::Workspace::prepare_stages(const GoalSequence& goals) {
  stages_.resize(static_cast<std::size_t>(goals.size()));
  Time latest = intervals_.latest_rest();
  if (latest == kNever) latest = std::numeric_limits<Time>::max();
  for (int k = last_progress_; k >= 0; --k) {
    const Cell goal = goals.goal(k);
    const Time deadline = intervals_.last_time(goal);
    if (deadline < kNever) latest = std::min(latest, deadline + goals.after_goal(k));
    stages_[k] = {.to_goal = goals.to_goal(k).data(),
                  .after_goal = goals.after_goal(k),
                  .next_goal = k == last_progress_ ? kNoCell : goal,
                  .latest = latest,
                  .gate_from = kNever,
                  .gate_until = 0};
  }
}

bool LowLevelSearch::Workspace::reserve_labels(const Limits& limits) {
  const std::size_t needed = stages_.size() * slots_;
  if (needed > labels_.size()) {
    if (!limits.memory_allows((needed - labels_.capacity()) * sizeof(Label))) {
      limits.memory_exhausted();
      return false;
    }
    labels_.resize(needed);
  }
  if (++stamp_ == 0) {
    std::ranges::fill(labels_, Label{});
    stamp_ = 1;
  }
  return true;
}

void LowLevelSearch::Workspace::start(Cell cell) {
  const int progress = advance(cell, 0);
  const Time f = f_of(cell, progress, 0);
  queue_.reset(f);
  const int slot = intervals_.start_slot(cell);
  if (slot == kNoSlot || f > stages_[progress].latest) return;
  label(slot, progress) = {.time = 0, .parent_slot = kNoSlot, .stamp = stamp_};
  queue_.push(f, {.slot = slot, .progress = static_cast<std::uint8_t>(progress)});
}

LowLevelSearch::Outcome LowLevelSearch::Workspace::run(const Limits& limits, Path& path) {
  Entry entry;
  while (queue_.pop(entry)) {
    if (is_stale(entry) || postpone(entry)) continue;
    if (is_finish(entry.slot, entry.progress)) {
      write_path(entry, path);
      return Outcome::kFound;
    }
    if (++expanded_ % kExpansionsPerPoll == 0 && limits.stop_requested()) return Outcome::kStopped;
    close_gate(entry);
    expand(entry);
  }
  return Outcome::kInfeasible;
}

// The label was improved since it was queued.
bool LowLevelSearch::Workspace::is_stale(const Entry& entry) {
  const Label& l = label(entry.slot, entry.progress);
  return l.time != entry.time || l.conflicts != entry.conflicts;
}

bool LowLevelSearch::Workspace::postpone(const Entry& entry) {
  const Stage& stage = stages_[entry.progress];
  if (stage.gate_until <= queue_.layer()) return false;
  const Cell cell = intervals_.cell_of(entry.slot);
  if (f_of(cell, entry.progress, entry.time) < stage.gate_from) return false;
  if (stage.gate_until < kNever) queue_.push(stage.gate_until, entry);
  return true;
}

// One gate is kept per progress: the one that postpones furthest.
void LowLevelSearch::Workspace::close_gate(const Entry& entry) {
  const int goal = entry.progress - 1;
  const Cell cell = intervals_.cell_of(entry.slot);
  if (goal < 0 || stages_[goal].next_goal != cell) return;
  if (!intervals_.is_free_of_traversals(entry.slot)) return;
  const Time from = entry.time + stages_[goal].after_goal;
  const Time next = intervals_.next_begin(entry.slot);
  const Time until = next == kNever ? kNever : next + stages_[goal].after_goal;
  for (int p = 0; p <= goal; ++p) {
    Stage& stage = stages_[p];
    if (until < stage.gate_until || (until == stage.gate_until && from >= stage.gate_from))
      continue;
    stage.gate_from = from;
    stage.gate_until = until;
  }
}

void LowLevelSearch::Workspace::expand(const Entry& entry) {
  const Cell from = intervals_.cell_of(entry.slot);
  intervals_.for_each_move(grid_, entry.slot, entry.time, [&](int slot, Cell cell, Time time) {
    arrive(entry, from, slot, cell, time);
  });
}

void LowLevelSearch::Workspace::arrive(const Entry& from, Cell from_cell, std::int32_t slot,
                                       Cell cell, Time time) {
  const int progress = advance(cell, from.progress);
  const Time f = f_of(cell, progress, time);
  if (f > stages_[progress].latest) return;
  Label& l = label(slot, progress);
  const bool known = l.stamp == stamp_;
  if (known && (l.time < time || (l.time == time && l.conflicts <= from.conflicts))) return;
  const std::uint16_t conflicts =
      others_ ? conflicts_on_arrival(from, from_cell, cell, time) : std::uint16_t{0};
  if (known && l.time == time && l.conflicts <= conflicts) return;

  l = {.time = time,
       .parent_slot = from.slot,
       .stamp = stamp_,
       .conflicts = conflicts,
       .parent_progress = from.progress};
  // No path is cheaper than a finish at the begin of its interval: it need not wait for its f.
  const bool optimal = time == finish_begin_ && is_finish(slot, progress);
  queue_.push(optimal ? queue_.layer() : std::max(f, queue_.layer()),
              {.slot = slot,
               .time = time,
               .conflicts = conflicts,
               .progress = static_cast<std::uint8_t>(progress)});
}

std::uint16_t LowLevelSearch::Workspace::conflicts_on_arrival(const Entry& from, Cell from_cell,
                                                              Cell cell, Time time) const {
  int count = from.conflicts + others_->conflicts(from_cell, cell, time);
  if (time > from.time + 1)
    count += others_->conflicts_of_waiting(from_cell, from.time + 1, time - 1);
  return static_cast<std::uint16_t>(std::min<int>(count, BucketQueue::kMostConflicts));
}

void LowLevelSearch::Workspace::write_path(const Entry& finish, Path& path) {
  std::int32_t slot = finish.slot;
  int progress = finish.progress;
  Time end = finish.time;
  path.resize(static_cast<std::size_t>(end) + 1);
  while (slot != kNoSlot) {
    const Label& l = label(slot, progress);
    std::fill(path.begin() + l.time, path.begin() + end + 1, intervals_.cell_of(slot));
    end = l.time - 1;
    slot = l.parent_slot;
    progress = l.parent_progress;
  }
}

}  // namespace grove
