// SPDX-License-Identifier: MIT
// Safe intervals: the times at which an agent may be in each state, derived from constraints or
// reservations.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/assert.h"
#include "planning/constraint.h"
#include "planning/corridors.h"
#include "planning/reservation_table.h"

namespace grove::detail {

// A state, a range of times at which the agent may be on its place, and those properties of the
// arrival on which the continuations depend. The agent can always wait inside the interval, because
// constraints bar places and moves, never waits.
struct SafeInterval {
  State state = kNoState;
  Time begin = 0;
  Time end = kNever;           // inclusive; kNever: forever
  Time last_arrival = kNever;  // agents that arrive later are in another interval
  std::uint8_t copy = 0;       // copy of the place, see SafeIntervals
  bool may_rest = false;       // may the agent rest here forever?
  // With reservations: the place to which the previous agent moves when it leaves this place;
  // kNoPlace if there was none.
  Place left_for = kNoPlace;
  bool is_late = false;  // its agents arrived too late to rest (kRestBy)
};

// The safe intervals of all states under one list of constraints. Intervals are numbered as
// *slots*. Most places have no constraint and take no memory except one number: a state there has
// only one interval, which is all of time, and the slot of this interval has the number of the
// state. The intervals of states on other places are the slots from World::state_count() on. Those
// of one state are contiguous and, within a copy (see below), in order of time. One object can be
// assigned many lists, one after another. Each list takes O(constraints), plus sorting and the
// length of the corridors with barred traversals; the first list that bars a traversal also takes
// O(places). One thread at a time.
//
// With reservations instead of constraints, the intervals of a place are made when they are needed:
// the caller must call ensure_intervals() before any other query about the place. With constraints
// ensure_intervals() does nothing.
//
// Each arrival leads to one slot, and the slot determines the continuations after the arrival:
//
// - *No rest by t.* If the interval [b, inf) of a place has b <= t, it becomes two overlapping
//   slots. An agent that arrives at t or earlier may stay for any time, but not forever. An agent
//   that arrives later may rest. (A turn on the place is no arrival: the time of arrival is the
//   time at which the agent came to the place.)
// - *Rest by t.* If agents can turn or execute tasks after their last arrival, the interval is
//   divided in the same way: an agent that arrives at t or earlier may rest, one that arrives later
//   may not.
// - *No traversal.* The inner places of a corridor with such a constraint have all their slots in
//   two or three *copies*. An agent that enters the corridor at one of its ends is in the copy for
//   that end until it leaves the corridor, and the constraint bars a move out of one copy only. In
//   the last copy no traversal is barred. It contains agents that entered at an end from which
//   traversals are permitted, and agents that are inside at time 0.
class SafeIntervals {
 public:
  // `world` must outlive this object.
  explicit SafeIntervals(const World& world);

  // Replaces the constraints. The list can have any order, overlaps and duplicates. Throws
  // std::invalid_argument for a place outside the world, a move from a place to itself, a traversal
  // that does not leave a corridor, or a constraint on the sequence.
  void assign(std::span<const Constraint> constraints);
  // Replaces the constraints by reservations: bars all places, moves and rests that would collide
  // with a reserved path. `reservations` must exist and not change until the next assign().
  void assign(const ReservationTable& reservations);

  void ensure_intervals(Place place) {
    if (reservations_ && group_of_[place] == kNoGroup) add_reserved_place(place);
  }
  // Upper bound on slot_count() until the next assign().
  int slot_limit() const { return slot_limit_; }
  int slot_count() const { return states_ + static_cast<int>(intervals_.size()); }
  State state_of(int slot) const { return slot < states_ ? slot : interval(slot).state; }
  Place place_of(int slot) const { return world_.place(state_of(slot)); }
  Time begin_of(int slot) const { return slot < states_ ? 0 : interval(slot).begin; }
  Time end_of(int slot) const { return slot < states_ ? kNever : interval(slot).end; }
  // Last time of arrival in this slot. An agent that comes to the place later is in another slot.
  Time last_arrival(int slot) const {
    return slot < states_ ? kNever : interval(slot).last_arrival;
  }
  // May an agent that arrived in this slot stay forever? If states are places, this does not test
  // the time of kRestBy, because the last arrival is then the finish, which callers compare with
  // latest_rest().
  bool may_rest(int slot) const {
    return (only_rest_ == kNoPlace || place_of(slot) == only_rest_) &&
           (slot < states_ || interval(slot).may_rest);
  }
  // The last time at which a move from `from_slot` to `slot` can arrive, without regard to barred
  // moves.
  Time last_entry(int from_slot, int slot) const {
    return place_of(from_slot) == place_of(slot)
               ? end_of(from_slot)
               : std::min(end_of(from_slot) + 1, last_arrival(slot));
  }
  // True if an agent in this slot has, until next_begin(), all continuations of an agent in any
  // other slot of this state at the same time or later. False for a copy with a barred traversal,
  // and after an arrival that is too late to rest (kRestBy).
  bool may_dominate(int slot) const {
    return copy_of(slot) == kFree && !(slot >= states_ && interval(slot).is_late);
  }

  // True if each state on the place has only the slot of all times, because no constraint or
  // reserved path requires other slots.
  bool unconstrained(Place place) const { return group_of_[place] == kNoGroup; }
  // The slots of a state are first_slot(state), ..., end_slot(state) - 1. There may be none.
  int first_slot(State state) const {
    const Place place = world_.place(state);
    return unconstrained(place) ? state : slots(groups_[group_of_[place]], state).first;
  }
  int end_slot(State state) const {
    const Place place = world_.place(state);
    return unconstrained(place) ? state + 1 : slots(groups_[group_of_[place]], state).end;
  }
  // The slot of an agent that starts in `state` at time 0; -1 if the agent may not be there.
  int start_slot(State state) const;
  // The start of the first slot of `place` in which the agent may rest; kNever if there is none.
  Time rest_begin(Place place) const;
  // The last time at which the agent may be on `place`; -1 if there is none.
  Time last_time(Place place) const {
    return first_slot(place) == end_slot(place) ? -1 : end_of(end_slot(place) - 1);
  }
  // The start of the next slot of the same state and copy; kNever if there is none.
  Time next_begin(int slot) const;

  // The time by which the agent must have arrived at its place of rest (kRestBy); kNever: no limit.
  Time latest_rest() const { return latest_rest_; }
  // The only place on which the agent may rest (kRestBy); kNoPlace: any place. If two constraints
  // name different places, the value is negative and not kNoPlace.
  Place only_rest() const { return only_rest_; }

  // The first time of arrival, `earliest` or later, at which a move from `from_slot` to `to` is not
  // barred; later than kNever if there is none. Does not test whether an agent may be on `to` at
  // that time. Not for reservations.
  Time first_move(int from_slot, Place to, Time earliest) const;
  // The last time of arrival, `latest` or earlier, at which a move from `from_slot` to `to` is not
  // barred; negative if there is none. Not for reservations.
  Time last_move(int from_slot, Place to, Time latest) const;

  // Calls arrive(slot, state, time) for each slot to which an agent that is in `slot` at
  // `from_time` can move, with the earliest time of arrival. An agent that changes its state but
  // not its place stays in the interval in which it came to the place.
  template <class Arrive>
  void for_each_move(int slot, Time from_time, Arrive arrive) {
    if (states_are_places_)
      move_from(
          slot, from_time, [](State state) { return state; }, arrive);
    else
      move_from(
          slot, from_time, [this](State state) { return world_.place(state); }, arrive);
  }

 private:
  static constexpr std::int32_t kNoGroup = -1;
  static constexpr std::int32_t kNoCopies = -1;
  static constexpr Place kNowhere = -2;
  // Copies of the inner places of a corridor.
  static constexpr std::uint8_t kFromFront = 0;
  static constexpr std::uint8_t kFromBack = 1;
  static constexpr std::uint8_t kFree = 2;  // last copy; also for places without copies

  struct Range {
    int first;
    int end;
  };

  // A stored constraint of one kind. kPlace: the place is barred at these times. kRest: the agent
  // must not come to rest there by `end`. kMove: a move to the place is barred, from all copies or
  // from one.
  struct Bar {
    enum class Kind : std::uint8_t { kPlace, kRest, kMove };
    Place place;
    Place from;
    Time begin;
    Time end;
    Kind kind;
    std::uint8_t copy;  // the copy that the move leaves; kFree: any
  };
  // A corridor with a barred traversal: the copies for agents that entered at each end; kFree if no
  // traversal from that end is barred.
  struct RestrictedCorridor {
    int corridor;
    std::uint8_t from_front = kFree;
    std::uint8_t from_back = kFree;
  };
  // Slots of one constrained place, and the range of its constraints in bars_.
  struct Group {
    Place place;
    std::int32_t first_slot = 0;  // of the first state on the place; other states follow
    std::int32_t slots = 0;       // number of slots of each state
    std::int32_t first_bar = 0;
    std::int32_t first_move = 0;  // the barred moves to the place come last
    std::int32_t end_move = 0;
    std::int32_t corridor = kNoCopies;  // of an inner place: index in restricted_corridors_
    Place front = kNoPlace;             // the front of that corridor, if adjacent
  };

  template <class PlaceOf, class Arrive>
  void move_from(int slot, Time from_time, PlaceOf place_of, Arrive arrive) {
    const State state = state_of(slot);
    const Place from = place_of(state);
    for (State next : world_.moves(state)) {
      const Place to = place_of(next);
      ensure_intervals(to);
      if (unconstrained(to))
        arrive(next, next, from_time + 1);
      else if (to == from)
        turn(slot, state, from_time, next, arrive);
      else
        enter_intervals(slot, from, from_time, next, to, arrive);
    }
  }

  template <class Arrive>
  void turn(int slot, State state, Time from_time, State next, Arrive arrive) const {
    const Group& group = groups_[group_of_[world_.place(state)]];
    const int there = slot + slots(group, next).first - slots(group, state).first;
    GROVE_ASSERT(state_of(there) == next && end_of(there) == end_of(slot),
                 "the states on a place have their slots in the same order");
    if (from_time < end_of(slot)) arrive(there, next, from_time + 1);
  }

  template <class Arrive>
  void enter_intervals(int from_slot, Place from, Time from_time, State state, Place to,
                       Arrive arrive) const {
    const Time last_arrival = end_of(from_slot) + 1;
    const Group& group = groups_[group_of_[to]];
    auto [slot, end] = slots_entered(group, from_slot, from, state);
    for (slot = first_ending_after(slot, end, from_time); slot < end; ++slot) {
      const Time begin = begin_of(slot);
      const Time last = std::min(interval(slot).last_arrival, last_arrival);
      if (begin > last_arrival) break;
      Time time = std::max(begin, from_time + 1);
      if (!reservations_)
        time = first_move(from_slot, to, time);
      else if (time == begin && interval(slot).left_for == from)
        continue;  // swap conflict; a wait on `from` would collide, too
      GROVE_ASSERT(time > last || (time > from_time && state_of(slot) == state),
                   "a move takes a step and leads to a slot of its state");
      if (time <= last) arrive(slot, state, time);
    }
  }

  // The slots of a state on the place.
  Range slots(const Group& group, State state) const {
    const int first = group.first_slot + world_.rank_on_place(state) * group.slots;
    return {first, first + group.slots};
  }
  // The slots of `state` that a move from `from` can lead to, at any time.
  Range slots_entered(const Group& to, int from_slot, Place from, State state) const {
    if (to.corridor == kNoCopies) return slots(to, state);
    const RestrictedCorridor& corridor = restricted_corridors_[to.corridor];
    // A neighbor with copies is an inner place of the same corridor.
    if (has_copies(from)) return slots_of_copy(to, state, interval(from_slot).copy);
    return slots_of_copy(to, state, from == to.front ? corridor.from_front : corridor.from_back);
  }
  Range slots_of_copy(const Group& group, State state, std::uint8_t copy) const;
  bool has_copies(Place place) const {
    return !unconstrained(place) && groups_[group_of_[place]].corridor != kNoCopies;
  }
  std::uint8_t copy_of(int slot) const { return slot < states_ ? kFree : interval(slot).copy; }

  const SafeInterval& interval(int slot) const { return intervals_[slot - states_]; }
  // The first slot of [first, end) that ends after `time`; `end` if there is none. The slots must
  // be of one state and copy.
  int first_ending_after(int first, int end, Time time) const {
    for (int many = end - first; many > 0;) {
      const int half = many / 2;
      if (end_of(first + half) <= time) {
        first += half + 1;
        many -= half + 1;
      } else {
        many = half;
      }
    }
    return first;
  }
  bool bars(const Bar& bar, int from_slot, Time time) const {
    return bar.from == place_of(from_slot) && bar.begin <= time && time <= bar.end &&
           (bar.copy == kFree || bar.copy == copy_of(from_slot));
  }
  bool is_barred(const Group& group, int from_slot, Time time) const {
    for (int i = group.first_move; i < group.end_move; ++i)
      if (bars(bars_[i], from_slot, time)) return true;
    return false;
  }
  void add_reserved_place(Place place);
  void forget();
  void check(const Constraint& constraint);
  void keep(const Constraint& constraint);
  void keep_bar(const Constraint& constraint);
  void keep_rest_by(const Constraint& constraint);
  void keep_traversal(const Constraint& constraint);
  bool leaves_at_front(const Constraint& constraint) const;
  bool leaves_at_back(const Constraint& constraint) const;
  RestrictedCorridor& restricted_corridor(int corridor);
  Group& group(Place place);
  void group_inner_places();
  void group_bars();
  void add(const SafeInterval& interval);
  void add_slots(Group& group);
  void add_intervals(const Group& group, State state, std::uint8_t copy);
  void add_unending_interval(const Group& group, State state, Time begin, std::uint8_t copy);

  const World& world_;
  State states_;
  bool states_are_places_;
  int slot_limit_ = 0;
  const ReservationTable* reservations_ = nullptr;
  std::vector<std::int32_t> group_of_;  // by place
  std::vector<Group> groups_;
  std::vector<SafeInterval> intervals_;
  std::vector<Bar> bars_;               // by place, kind, begin
  std::optional<Corridors> corridors_;  // made for the first barred traversal
  std::vector<RestrictedCorridor> restricted_corridors_;
  Place only_rest_ = kNoPlace;
  Time latest_rest_ = kNever;
};

}  // namespace grove::detail
