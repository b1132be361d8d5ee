// SPDX-License-Identifier: MIT
// The low level over all sequences of a class at once: A* over safe intervals (see
// low_level_search.cpp for what the two share: intervals, dominance by the earliest arrival, ties)
// in which a label is a (cell, safe interval, state), a state being what is left to visit
// (free_goals.cpp: touching a stop that may be counted counts it). So it solves at once what the
// low levels of multi-goal CBS split into orders and paths (MGCBS: Tang et al., IJCAI 2024), with
// the exact cost of completing as heuristic, from the sequence graph.
//
// Heuristic. h(cell, state) = min over the stops u next of dist(cell, u) + completion of the rest
// from u: exact without constraints if the completions know all sequences. Nothing left: the
// distance to the destination, or without one to the nearest stop that may be rested on.
//
// Dominance. A path from a label on depends on the cell, the interval and the state alone, an
// earlier arrival can wait for a later one, and waiting changes no state. So one label with the
// earliest time each suffices, as with a fixed sequence.
//
// The end. Nothing left, on a place to rest, in an interval in which one may rest: a cell barred
// for ever is no place to rest. No path costs less than the first begin of such an interval, so a
// finish at that time is optimal at once.
//
// Target reasoning. "Does not rest on v by t" (kNoRestBy) makes two overlapping intervals of v's
// last one, by the time of arrival: up to t, where one may not rest, and later. "Rests on v by t"
// (kRestBy) leaves one place to rest and acts as a cutoff of t, but what is above it is infeasible.
// The heuristic then is at least the distance to v.
//
// Traversals. A move that kNoTraversal bars is barred to those who came in at the other end. That
// is all of the past that a future can depend on, and the inner cells of such a chain have their
// intervals once for each end, and once for whoever has been inside since the start (an end whose
// traversals are free shares that one: safe_intervals.h). So a path is again a matter of cell,
// interval and state, and the move is delayed like any barred move.
//
// Exactness with a bounded graph. The completions know every sequence cheaper than beyond(). Labels
// in states that they do not know are dropped, and so are labels of f > beyond().
// *Claim: no path that costs less than beyond() is lost.* Take such a path P that realizes a
// sequence of the class, and count as early as possible: that realizes a sequence s too. P visits
// the stops of s in turn, so s costs at most what P costs, less than beyond(): all states of s are
// known with their exact completions, which are at most what P still pays. So every label along P
// has t + h <= cost(P). The search may hold, instead of P's label, an earlier one of the same cell,
// interval and state; then the way there with the remainder of P after it, waiting in between, is
// again a path of the class, no dearer than P, and the argument holds for it: what the graph misses
// of other ways does not matter. With a deadline or gate below it is the same path that goes on.
// So: a path found that costs at most beyond() is optimal, since a cheaper one would not have been
// lost. If none is found, every path costs at least beyond(); then the graph is widened and the
// search begun again, unless the cutoff is below beyond(): kAbove. And if no label was dropped for
// its f or for its state, the search has seen all there is: kInfeasible, whatever the graph.
//
// Early ends. No path costs less than the first rest, so one that costs just that is optimal
// whatever its sequence: where the first rest is later than beyond(), labels are kept up to there.
//
// Late costs. Under cells barred for ever the completions know nothing of the way around, and a
// search that they mislead tries all orders. So once per hard call, and before the completions are
// widened, legs are priced anew (late_costs.cpp). If the best sequence costs more by these, then
// the search begins again with completions of its own over them. All of the above holds with these
// costs in place of the plain ones: a path through the stops of s costs at least what s costs, and
// what is left of it costs at least the completion from any of its states on.
//
// Cutoff. Labels of f > cutoff are dropped. "Above" then says no more than that no path costs the
// cutoff or less.
//
// Deadlines. If a stop is barred for ever after time d, a label that has it left is of use only if
// t + dist(cell, stop) <= d.
//
// Gates. A label is put off, or dropped, if others that were expanded on stops stand for its ways
// on (gates.cpp).
//
// Known sequences. A heuristic that wants any good path may do without the others: then the cap is
// the cutoff itself, a path found is one of a known sequence, and none found proves nothing, unless
// all are known.
//
// Greed. With a weight on the cost to go (Pohl 1970) labels come out in another order; what is
// dropped is dropped by t + h and by gates as before, and neither argument speaks of the order. So
// the first finish is a path within the cutoff, if perhaps not the cheapest, and the other outcomes
// are proven.
//
// Infeasible cases can cost all 2^n sets: with time windows the question is NP-hard; and so can
// cases far above the cutoff. Most are a door shut before or behind the agent, so once per hard
// call each stop is asked for alone (visit_check.cpp): a bound on the cost.
//
// Measured on the benchmark's 32x32 maps with obstacles (nine other agents, one core, median of a
// call in microseconds; n = 5, 10, 20): 6, 14, 24 without constraints; 17, 35, 57 with 20 of them
// on the paths found; 34, 64, 138 with 60. A fixed sequence takes 5, 8, 15; 12, 14, 22; 21, 24, 31.
#include "grove/planning/free_low_level_search.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "gates.h"
#include "grove/planning/bucket_queue.h"
#include "grove/planning/safe_intervals.h"
#include "label_planes.h"
#include "late_costs.h"
#include "visit_check.h"

namespace grove {
namespace {

constexpr std::int64_t kLabelsPerPoll = 256;
// After so many in one call, or before the completions are widened a second time, it is worth
// asking whether each stop can be visited at all, or in time.
constexpr std::int64_t kExpansionsBeforeDoubt = 1 << 12;
// After so many in one call legs are priced anew: the work of some milliseconds, as pricing is.
constexpr std::int64_t kExpansionsBeforePricing = 1 << 13;

}  // namespace

class FreeLowLevelSearch::Workspace {
 public:
  explicit Workspace(const Grid& grid)
      : grid_(grid), intervals_(grid), visit_check_(grid, intervals_) {}

  Outcome find(FreeGoals& goals, std::span<const Constraint> constraints,
               const ConflictAvoidanceTable* others, Time cutoff, const Limits& limits, Path& path,
               std::int64_t most_labels);
  Outcome find(FreeGoals& goals, const Reservations& reservations, const Effort& effort,
               Time cutoff, const Limits& limits, Path& path);
  std::int64_t expanded() const { return expanded_; }

 private:
  using StateId = FreeGoals::StateId;
  using Queue = BasicBucketQueue<StateId>;
  using Entry = Queue::Entry;

  struct Label {
    Time time;
    std::int32_t parent_slot;
    StateId parent_state;
    std::uint32_t stamp;
    std::uint16_t conflicts;
  };
  // A stop that is barred for ever after `time`.
  struct Deadline {
    int stop;
    Time time;
  };

  static constexpr std::int32_t kNoSlot = -1;
  static constexpr std::int64_t kNoDoubt = std::numeric_limits<std::int64_t>::max();

  Outcome find_around(FreeGoals& goals, const ConflictAvoidanceTable* others, const Effort& effort,
                      bool doubts, Time cutoff, const Limits& limits, Path& path);
  bool prepare();
  void see_stops();
  void find_only_rest();
  Time first_rest() const;
  void find_deadlines();
  Outcome find_within(Time cap, const Limits& limits, Path& path);
  void start();
  Outcome run(const Limits& limits, Path& path);

  bool is_hopeless();
  bool price_anew();
  Time least_cost();
  // At most what a path from here on costs.
  Time distance(StateId state, Cell cell) const {
    const Time distance = goals_->distance(state, cell);
    if (only_rest_ == AgentStops::kNoStop) return distance;
    return std::max(distance, goals_->stops().distances_from(cell)[only_rest_]);
  }
  bool misses_deadline(StateId state, Cell cell, Time time) const;
  bool is_finish(const Entry& entry) const;
  bool is_stale(const Entry& entry);
  bool postpone(const Entry& entry);
  void close_gate(const Entry& entry);
  void expand(const Entry& entry);
  void arrive(const Entry& from, Cell from_cell, std::int32_t slot, Cell cell, Time time);
  void touch(const Entry& from, Cell from_cell, std::int32_t slot, Cell cell, Time time);
  void reach(const Entry& from, Cell from_cell, std::int32_t slot, Cell cell, Time time,
             StateId state);
  std::uint16_t conflicts_on_arrival(const Entry& from, Cell from_cell, Cell cell, Time time) const;
  Time layer_of(Time least_cost, Time distance) const {
    return least_cost + static_cast<Time>(std::int64_t{distance} * greed_percent_ / 100);
  }
  void write_path(const Entry& finish, Path& path);

  const Grid& grid_;
  SafeIntervals intervals_;
  VisitCheck visit_check_;
  Queue queue_;
  LabelPlanes<Label> planes_;
  Gates gates_;
  std::vector<Deadline> deadlines_;
  std::int64_t expanded_ = 0;

  // Of the call under way.
  FreeGoals* goals_ = nullptr;
  const ConflictAvoidanceTable* others_ = nullptr;
  const Limits* limits_ = nullptr;
  int greed_percent_ = 0;
  std::int64_t give_up_at_ = 0;         // the count of labels
  Time first_rest_ = 0;                 // no path costs less
  int only_rest_ = -1;                  // without a destination: the only stop to rest on, perhaps
  Time cap_ = 0;                        // dearer labels are dropped
  bool over_ = false;                   // one was
  Time latest_ = 0;                     // dearer paths are of no use,
  Outcome above_ = Outcome::kAbove;     // and this is the answer if all are
  Outcome hopeless_ = Outcome::kAbove;  // what is_hopeless() found
  std::int64_t doubt_at_ = 0;  // the count of labels at which to ask, once, if there is hope
  bool outside_ = false;       // a label was dropped whose state the completions do not know
  std::int64_t price_at_ = 0;  // the count of labels at which to price legs anew, once
  bool priced_ = false;        // they were, while a search was under way: it must begin again
  std::optional<Completions> late_completions_;
  std::optional<FreeGoals> late_goals_;  // over these
};

FreeLowLevelSearch::FreeLowLevelSearch(const Grid& grid)
    : workspace_(std::make_unique<Workspace>(grid)) {}
FreeLowLevelSearch::~FreeLowLevelSearch() = default;

FreeLowLevelSearch::Outcome FreeLowLevelSearch::find(FreeGoals& goals,
                                                     std::span<const Constraint> constraints,
                                                     const ConflictAvoidanceTable* others,
                                                     Time cutoff, const Limits& limits, Path& path,
                                                     std::int64_t most_labels) {
  return workspace_->find(goals, constraints, others, cutoff, limits, path, most_labels);
}

FreeLowLevelSearch::Outcome FreeLowLevelSearch::find(FreeGoals& goals,
                                                     const Reservations& reservations,
                                                     const Effort& effort, Time cutoff,
                                                     const Limits& limits, Path& path) {
  return workspace_->find(goals, reservations, effort, cutoff, limits, path);
}

std::int64_t FreeLowLevelSearch::expanded() const {
  return workspace_->expanded();
}

FreeLowLevelSearch::Outcome FreeLowLevelSearch::Workspace::find(
    FreeGoals& goals, std::span<const Constraint> constraints, const ConflictAvoidanceTable* others,
    Time cutoff, const Limits& limits, Path& path, std::int64_t most_labels) {
  intervals_.assign(constraints);
  return find_around(goals, others, {.most_labels = most_labels}, true, cutoff, limits, path);
}

FreeLowLevelSearch::Outcome FreeLowLevelSearch::Workspace::find(FreeGoals& goals,
                                                                const Reservations& reservations,
                                                                const Effort& effort, Time cutoff,
                                                                const Limits& limits, Path& path) {
  intervals_.assign(reservations);
  // Whoever gives up after so many labels wants no proof.
  const bool doubts = effort.most_labels == Effort().most_labels;
  return find_around(goals, nullptr, effort, doubts, cutoff, limits, path);
}

FreeLowLevelSearch::Outcome FreeLowLevelSearch::Workspace::find_around(
    FreeGoals& goals, const ConflictAvoidanceTable* others, const Effort& effort, bool doubts,
    Time cutoff, const Limits& limits, Path& path) {
  if (limits.stop_requested()) return Outcome::kStopped;
  goals_ = &goals;
  others_ = others;
  limits_ = &limits;
  greed_percent_ = effort.greed_percent;
  give_up_at_ =
      effort.most_labels < kUnlimited - expanded_ ? expanded_ + effort.most_labels : kUnlimited;
  if (!prepare()) return Outcome::kInfeasible;
  latest_ = std::min(cutoff, intervals_.latest_rest());
  const bool must_rest = intervals_.latest_rest() < kNever;
  above_ = must_rest && intervals_.latest_rest() <= cutoff ? Outcome::kInfeasible : Outcome::kAbove;
  if (first_rest_ > latest_) return above_;

  doubt_at_ = doubts ? expanded_ + kExpansionsBeforeDoubt : kNoDoubt;
  price_at_ = expanded_ + kExpansionsBeforePricing;
  if (effort.known_sequences && goals_->completions().beyond() <= cutoff) {
    price_at_ = kNoDoubt;
    const Outcome outcome = find_within(cutoff, limits, path);
    const bool all_known = goals_->completions().beyond() == kNever;
    return outcome == Outcome::kFound || all_known ? outcome : Outcome::kStopped;
  }
  for (;;) {
    priced_ = false;
    const Time optimal = std::max(goals_->completions().beyond(), first_rest_);
    const Outcome outcome = find_within(std::min(latest_, optimal), limits, path);
    if (priced_) continue;
    Completions& completions = goals_->completions();
    if (outcome == Outcome::kAbove && latest_ < completions.beyond()) return above_;
    if (outcome != Outcome::kAbove) return outcome;
    if (completions.beyond() == kNever) return outcome;
    if (goals_->first_state() != FreeGoals::kOutside) {
      if (is_hopeless()) return hopeless_;
      if (price_anew()) continue;
    }
    if (!completions.widen(completions.beyond(), limits)) return Outcome::kStopped;
  }
}

// False when there is plainly no path.
bool FreeLowLevelSearch::Workspace::prepare() {
  see_stops();
  find_deadlines();
  find_only_rest();
  first_rest_ = first_rest();
  return first_rest_ < kNever && first_rest_ <= intervals_.latest_rest() && goals_->plausible();
}

void FreeLowLevelSearch::Workspace::see_stops() {
  const AgentStops& stops = goals_->stops();
  intervals_.see(stops.start());
  if (stops.destination()) intervals_.see(*stops.destination());
  for (int stop = 0; stop < stops.count(); ++stop) intervals_.see(stops.cell(stop));
}

// When the agent may first come to rest anywhere for ever.
Time FreeLowLevelSearch::Workspace::first_rest() const {
  const AgentStops& stops = goals_->stops();
  if (stops.destination()) return intervals_.rest_begin(*stops.destination());
  Time first = kNever;
  for (int stop = 0; stop < stops.count(); ++stop)
    first = std::min(first, intervals_.rest_begin(stops.cell(stop)));
  return first;
}

// Of use only without a destination: with one, the heuristic knows it.
void FreeLowLevelSearch::Workspace::find_only_rest() {
  only_rest_ = AgentStops::kNoStop;
  const AgentStops& stops = goals_->stops();
  if (stops.destination()) return;
  for (int stop = 0; stop < stops.count(); ++stop)
    if (stops.cell(stop) == intervals_.only_rest()) only_rest_ = stop;
}

void FreeLowLevelSearch::Workspace::find_deadlines() {
  const AgentStops& stops = goals_->stops();
  deadlines_.clear();
  for (int stop = 0; stop < stops.count(); ++stop) {
    const Time last = intervals_.last_time(stops.cell(stop));
    if (last < kNever) deadlines_.push_back({stop, last});
  }
}

// A path of least cost, if the cost is at most `cap`; of least cost if that is at most beyond().
FreeLowLevelSearch::Outcome FreeLowLevelSearch::Workspace::find_within(Time cap,
                                                                       const Limits& limits,
                                                                       Path& path) {
  cap_ = cap;
  over_ = outside_ = false;
  gates_.begin_search();
  planes_.begin_search(intervals_.slot_limit());
  start();
  return run(limits, path);
}

void FreeLowLevelSearch::Workspace::start() {
  const Cell cell = goals_->stops().start();
  const StateId state = goals_->first_state();
  queue_.reset(0);
  const int slot = intervals_.start_slot(cell);
  if (slot == kNoSlot) return;
  if (state == FreeGoals::kOutside) {
    outside_ = true;
    return;
  }
  arrive({.slot = kNoSlot, .time = -1, .progress = state}, cell, slot, cell, 0);
}

FreeLowLevelSearch::Outcome FreeLowLevelSearch::Workspace::run(const Limits& limits, Path& path) {
  Entry entry;
  while (queue_.pop(entry)) {
    if (is_stale(entry) || postpone(entry)) continue;
    if (is_finish(entry)) {
      write_path(entry, path);
      return Outcome::kFound;
    }
    if (++expanded_ % kLabelsPerPoll == 0) {
      if (expanded_ >= give_up_at_ || limits.stop_requested()) return Outcome::kStopped;
      if (expanded_ >= doubt_at_ && is_hopeless()) return hopeless_;
      if (expanded_ >= price_at_ && price_anew()) {
        priced_ = true;
        return Outcome::kStopped;
      }
    }
    close_gate(entry);
    expand(entry);
  }
  if (planes_.exhausted()) return Outcome::kStopped;
  const bool bounded = goals_->completions().beyond() < kNever;
  return over_ || (bounded && outside_) ? Outcome::kAbove : Outcome::kInfeasible;
}

// True if the search should begin again, with completions that know better. Once a call.
bool FreeLowLevelSearch::Workspace::price_anew() {
  if (price_at_ == kNoDoubt) return false;
  price_at_ = kNoDoubt;
  const Time plain = least_cost();
  auto matrix = late_cost_matrix(grid_, intervals_, goals_->stops(), plain);
  if (!matrix) return false;
  FreeGoals* const plain_goals = goals_;
  late_goals_.reset();
  if (!late_completions_ || late_completions_->matrix().cost != matrix->cost)
    late_completions_.emplace(std::move(*matrix));  // else those of a call before serve on
  late_goals_.emplace(plain_goals->stops(), plain_goals->sequence_class(), *late_completions_);
  goals_ = &*late_goals_;
  while (late_completions_->beyond() <= plain && least_cost() >= late_completions_->beyond())
    if (!late_completions_->widen(late_completions_->beyond(), *limits_)) break;
  if (least_cost() > plain) return true;
  goals_ = plain_goals;
  return false;
}

// At most what any sequence of the class costs, by the completions.
Time FreeLowLevelSearch::Workspace::least_cost() {
  const Time beyond = goals_->completions().beyond();
  const StateId state = goals_->first_state();
  if (state == FreeGoals::kOutside) return beyond;
  return std::min(beyond, goals_->distance(state, goals_->stops().start()));
}

// Is there surely no path, or none in time, or no time to find out? Asks once a call.
bool FreeLowLevelSearch::Workspace::is_hopeless() {
  if (doubt_at_ == kNoDoubt) return false;
  doubt_at_ = kNoDoubt;
  const AgentStops& stops = goals_->stops();
  std::vector<Cell> rests;
  for (int stop = 0; stop < stops.count(); ++stop) rests.push_back(stops.cell(stop));
  const std::vector<Cell> visits = rests;
  if (stops.destination()) rests = {*stops.destination()};
  Time rest = 0;
  for (const Cell cell : visits) {
    rest = std::max(rest, visit_check_.first_rest(stops.start(), cell, rests));
    if (!limits_->stop_requested()) continue;
    hopeless_ = Outcome::kStopped;
    return true;
  }
  hopeless_ = rest >= kNever ? Outcome::kInfeasible : above_;
  return rest >= kNever || rest > latest_;
}

bool FreeLowLevelSearch::Workspace::is_finish(const Entry& entry) const {
  const FreeGoals::State& state = goals_->state(entry.progress);
  return state.left == 0 && goals_->is_rest(state, intervals_.cell_of(entry.slot)) &&
         intervals_.may_rest(entry.slot);
}

// The label was improved since it was queued.
bool FreeLowLevelSearch::Workspace::is_stale(const Entry& entry) {
  const Label& l = planes_.label(entry.slot, entry.progress);
  return l.time != entry.time || l.conflicts != entry.conflicts;
}

bool FreeLowLevelSearch::Workspace::misses_deadline(StateId state, Cell cell, Time time) const {
  const AgentStops& stops = goals_->stops();
  const StopSet left = goals_->state(state).left;
  return std::ranges::any_of(deadlines_, [&](const Deadline& d) {
    return (left >> d.stop & 1) != 0 && time + stops.distances_from(cell)[d.stop] > d.time;
  });
}

bool FreeLowLevelSearch::Workspace::postpone(const Entry& entry) {
  if (!gates_.any(entry.progress)) return false;
  const Cell cell = intervals_.cell_of(entry.slot);
  const Time until = gates_.least_cost(*goals_, entry.progress, cell, entry.time);
  if (until > cap_) {
    over_ |= until < kNever;
  } else {
    const Time distance = greed_percent_ == 0 ? 0 : goals_->distance(entry.progress, cell);
    const Time layer = layer_of(until, distance);
    if (layer <= queue_.layer()) return false;
    queue_.push(layer, entry);
  }
  const FreeGoals::State& state = goals_->state(entry.progress);
  if (std::popcount(state.next) != state.count) outside_ = true;
  return true;
}

void FreeLowLevelSearch::Workspace::close_gate(const Entry& entry) {
  const int stop = goals_->stops().stop_at(intervals_.cell_of(entry.slot));
  if (stop == AgentStops::kNoStop || !intervals_.is_free_of_traversals(entry.slot)) return;
  const Label& l = planes_.label(entry.slot, entry.progress);
  if (l.parent_slot == kNoSlot || l.parent_state == entry.progress) return;
  gates_.close(*goals_, l.parent_state, stop, entry.time, intervals_.next_begin(entry.slot));
}

void FreeLowLevelSearch::Workspace::expand(const Entry& entry) {
  const Cell from = intervals_.cell_of(entry.slot);
  intervals_.for_each_move(grid_, entry.slot, entry.time, [&](int slot, Cell cell, Time time) {
    arrive(entry, from, slot, cell, time);
  });
}

void FreeLowLevelSearch::Workspace::arrive(const Entry& from, Cell from_cell, std::int32_t slot,
                                           Cell cell, Time time) {
  if (goals_->may_count(from.progress, cell))
    touch(from, from_cell, slot, cell, time);
  else
    reach(from, from_cell, slot, cell, time, from.progress);
}

void FreeLowLevelSearch::Workspace::touch(const Entry& from, Cell from_cell, std::int32_t slot,
                                          Cell cell, Time time) {
  const bool known = goals_->on_arrival(
      from.progress, cell, [&](StateId state) { reach(from, from_cell, slot, cell, time, state); });
  if (!known) outside_ = true;
}

void FreeLowLevelSearch::Workspace::reach(const Entry& from, Cell from_cell, std::int32_t slot,
                                          Cell cell, Time time, StateId state) {
  if (!planes_.open(state, *limits_)) return;
  Label& l = planes_.label(slot, state);
  const bool known = planes_.is_current(l);
  if (known && (l.time < time || (l.time == time && l.conflicts <= from.conflicts))) return;
  if (!deadlines_.empty() && misses_deadline(state, cell, time)) return;
  const Time distance = this->distance(state, cell);
  if (distance >= kNever) outside_ = true;
  if (distance > cap_ - time) {
    over_ |= distance < kNever;
    return;
  }
  const std::uint16_t conflicts =
      others_ && time > 0 ? conflicts_on_arrival(from, from_cell, cell, time) : std::uint16_t{0};
  if (known && l.time == time && l.conflicts <= conflicts) return;

  l = {.time = time,
       .parent_slot = from.slot,
       .parent_state = from.progress,
       .stamp = planes_.stamp(),
       .conflicts = conflicts};
  const Entry entry{.slot = slot, .time = time, .conflicts = conflicts, .progress = state};
  // No path is cheaper than a rest as early as any may be: it need not wait for its f.
  const bool optimal = time == first_rest_ && is_finish(entry);
  queue_.push(
      optimal ? queue_.layer() : std::max(layer_of(time + distance, distance), queue_.layer()),
      entry);
}

std::uint16_t FreeLowLevelSearch::Workspace::conflicts_on_arrival(const Entry& from, Cell from_cell,
                                                                  Cell cell, Time time) const {
  int count = from.conflicts + others_->conflicts(from_cell, cell, time);
  if (time > from.time + 1)
    count += others_->conflicts_of_waiting(from_cell, from.time + 1, time - 1);
  return static_cast<std::uint16_t>(std::min<int>(count, Queue::kMostConflicts));
}

void FreeLowLevelSearch::Workspace::write_path(const Entry& finish, Path& path) {
  std::int32_t slot = finish.slot;
  StateId state = finish.progress;
  Time end = finish.time;
  path.resize(static_cast<std::size_t>(end) + 1);
  while (slot != kNoSlot) {
    const Label& l = planes_.label(slot, state);
    std::fill(path.begin() + l.time, path.begin() + end + 1, intervals_.cell_of(slot));
    end = l.time - 1;
    slot = l.parent_slot;
    state = l.parent_state;
  }
}

}  // namespace grove
