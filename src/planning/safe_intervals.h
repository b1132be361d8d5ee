// SPDX-License-Identifier: MIT
// When an agent may be where: constraints turned into intervals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planning/constraint.h"
#include "planning/corridors.h"
#include "planning/reservation_table.h"

namespace grove::detail {

// A state together with a range of times at which the agent may be on its place, and what is known
// of how it came there. It may always wait inside: constraints bar places and moves, never waits.
struct SafeInterval {
  State state = kNoState;
  Time begin = 0;
  Time end = kNever;           // inclusive; kNever: for ever
  Time last_arrival = kNever;  // whoever arrives later is in another interval
  std::uint8_t copy = 0;       // of the place, see SafeIntervals
  bool may_rest = false;       // for ever
  // With reservations: who was here before moves there at `begin`.
  Place left_for = kNoPlace;
  bool is_late = false;  // whoever came earlier may rest
};

// The safe intervals of all places under one list of constraints, for each state on them. Most
// places have no constraint and take no memory but a number: the one interval of a state there, all
// of time, is the *slot* with the number of the state. The intervals of states on other places are
// the slots from state_count() on, those of one state in a row and in order of time. Reused from
// list to list; O(constraints) each time but for sorting, and for the length of the chains that may
// not be traversed.
//
// With reservations instead of constraints the intervals of a place are made when it is first seen:
// see() must come before any other question about it. With constraints it does nothing.
//
// One arrival, one slot; a slot keeps what an arrival leads to:
//
// - *No rest by t.* If the interval [b, inf) of a place has b <= t, it is two overlapping slots:
// who
//   arrives at t or earlier may be there for as long as it likes, but not for ever; who arrives
//   later may rest. (Whoever turns on the place stays in its slot: it has arrived when it came.)
// - *Rest by t.* Where agents may turn or work after they have arrived for good, likewise: who
//   arrives at t or earlier may rest, who arrives later may not.
// - *No traversal.* The inner places of a chain with such a constraint have all their slots in two
//   or three *copies*. Who enters the chain at one of its ends gets the copy of that end and keeps
//   it until it leaves, and the constraint bars a move out of one copy only. The last copy bars
//   none: it is that of an end whose traversals are free, and of the start at time 0.
class SafeIntervals {
 public:
  // `world` must outlive this.
  explicit SafeIntervals(const World& world);

  // Replaces the constraints. They may come in any order, overlap and repeat. Throws
  // std::invalid_argument for a place outside the world, a move from one to itself, or a traversal
  // of what is no chain.
  void assign(std::span<const Constraint> constraints);
  // Bars what would collide with a reserved path. `reservations` must stay as they are until the
  // next assign().
  void assign(const ReservationTable& reservations);

  void see(Place place) {
    if (reservations_ && group_of_[place] == kNoGroup) look_up(place);
  }
  // There will not be more slots than this.
  int slot_limit() const { return slot_limit_; }
  int slot_count() const { return states_ + static_cast<int>(intervals_.size()); }
  State state_of(int slot) const { return slot < states_ ? slot : interval(slot).state; }
  Place place_of(int slot) const { return world_.place(state_of(slot)); }
  Time begin_of(int slot) const { return slot < states_ ? 0 : interval(slot).begin; }
  Time end_of(int slot) const { return slot < states_ ? kNever : interval(slot).end; }
  // Whoever comes to the place later is in another slot.
  Time last_arrival(int slot) const {
    return slot < states_ ? kNever : interval(slot).last_arrival;
  }
  // May the agent, having arrived in this slot, stay for ever? Where states are places the time of
  // kRestBy is not looked at: there the agent finishes when it arrives, see latest_rest().
  bool may_rest(int slot) const {
    return (only_rest_ == kNoPlace || place_of(slot) == only_rest_) &&
           (slot < states_ || interval(slot).may_rest);
  }
  // The last time at which a move from the one slot into the other may arrive, if it is not barred.
  Time last_entry(int from_slot, int slot) const {
    return place_of(from_slot) == place_of(slot)
               ? end_of(from_slot)
               : std::min(end_of(from_slot) + 1, last_arrival(slot));
  }
  // Can all that is done from another slot of this state, later or at the same time, be done from
  // here until next_begin()? Not from a copy that is barred from a traversal, nor by who came too
  // late to rest (kRestBy).
  bool stands_for_others(int slot) const {
    return copy_of(slot) == kFree && !(slot >= states_ && interval(slot).is_late);
  }

  // No constraint at all bars the place or a move to it, nor has it copies.
  bool unconstrained(Place place) const { return group_of_[place] == kNoGroup; }
  // The slots of a state: first_slot(state) .. end_slot(state) - 1, perhaps none.
  int first_slot(State state) const {
    const Place place = world_.place(state);
    return unconstrained(place) ? state : slots(groups_[group_of_[place]], state).first;
  }
  int end_slot(State state) const {
    const Place place = world_.place(state);
    return unconstrained(place) ? state + 1 : slots(groups_[group_of_[place]], state).end;
  }
  // Where an agent is that starts in `state` at time 0; -1: barred.
  int start_slot(State state) const;
  // The begin of the slot of `place` in which the agent may rest; kNever: there is none.
  Time rest_begin(Place place) const;
  // The last time at which the agent may be on `place`; -1: never.
  Time last_time(Place place) const {
    return first_slot(place) == end_slot(place) ? -1 : end_of(end_slot(place) - 1);
  }
  // When the slot of the same state and copy after `slot` begins; kNever if there is none.
  Time next_begin(int slot) const;

  // By when the agent must have come to where it rests (kRestBy); kNever: no matter.
  Time latest_rest() const { return latest_rest_; }
  // The only place to rest on, kNoPlace: no matter. Not a place at all if there are two such.
  Place only_rest() const { return only_rest_; }

  // The first time from `earliest` on at which an agent in `from_slot` is not barred from moving to
  // `to`; later than kNever when there is none. Whether `to` is safe then is another matter.
  // Not with reservations.
  Time first_move(int from_slot, Place to, Time earliest) const;
  // The last time up to `latest` at which it is not barred; negative when there is none.
  Time last_move(int from_slot, Place to, Time latest) const;

  // Calls arrive(slot, state, time) for each slot next to `slot` that an agent in it at `from_time`
  // can move to, with the first time at which it can be there. Whoever moves without leaving the
  // place stays in the interval that it came to the place in.
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
  // Copies of the inner places of a chain.
  static constexpr std::uint8_t kFromFront = 0;
  static constexpr std::uint8_t kFromBack = 1;
  static constexpr std::uint8_t kFree = 2;  // and of places without copies

  struct Range {
    int first;
    int end;
  };

  // A constraint as it is kept: times barred on a place, times by which none may have come to rest,
  // or a barred move to the place, perhaps from one copy only.
  struct Bar {
    enum class Kind : std::uint8_t { kPlace, kRest, kMove };
    Place place;
    Place from;
    Time begin;
    Time end;
    Kind kind;
    std::uint8_t copy;  // kFree: from any
  };
  // A chain with a barred traversal. A copy that no constraint bars is the free one.
  struct ChainUsed {
    int chain;
    std::uint8_t from_front = kFree;
    std::uint8_t from_back = kFree;
  };
  // What is known of one place: slots, and positions in bars_.
  struct Group {
    Place place;
    std::int32_t first_slot = 0;  // of the first state on it; those of the others follow
    std::int32_t slots = 0;       // of each state
    std::int32_t first_bar = 0;
    std::int32_t first_move = 0;  // the barred moves to the place come last
    std::int32_t end_move = 0;
    std::int32_t chain = kNoCopies;  // in chains_used_: whose inner place it is
    Place front = kNoPlace;          // the front of that chain, if next to it
  };

  template <class PlaceOf, class Arrive>
  void move_from(int slot, Time from_time, PlaceOf place_of, Arrive arrive) {
    const State state = state_of(slot);
    const Place from = place_of(state);
    for (State next : world_.moves(state)) {
      const Place to = place_of(next);
      see(to);
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
        continue;  // head-on; and later `from` is not safe any more
      if (time <= last) arrive(slot, state, time);
    }
  }

  // Those of a state on the place.
  Range slots(const Group& group, State state) const {
    const int first = group.first_slot + world_.rank_on_place(state) * group.slots;
    return {first, first + group.slots};
  }
  // The slots of `state` that a move from `from` may lead into.
  Range slots_entered(const Group& to, int from_slot, Place from, State state) const {
    if (to.chain == kNoCopies) return slots(to, state);
    const ChainUsed& chain = chains_used_[to.chain];
    // A neighbor with copies is an inner place of the same chain.
    if (has_copies(from)) return slots_of_copy(to, state, interval(from_slot).copy);
    return slots_of_copy(to, state, from == to.front ? chain.from_front : chain.from_back);
  }
  Range slots_of_copy(const Group& group, State state, std::uint8_t copy) const;
  bool has_copies(Place place) const {
    return !unconstrained(place) && groups_[group_of_[place]].chain != kNoCopies;
  }
  std::uint8_t copy_of(int slot) const { return slot < states_ ? kFree : interval(slot).copy; }

  const SafeInterval& interval(int slot) const { return intervals_[slot - states_]; }
  // Of some slots of one state and copy, in a row.
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
  void look_up(Place place);
  void forget();
  void check(const Constraint& constraint);
  void keep(const Constraint& constraint);
  void keep_bar(const Constraint& constraint);
  void keep_rest_by(const Constraint& constraint);
  void keep_traversal(const Constraint& constraint);
  bool leaves_at_front(const Constraint& constraint) const;
  bool leaves_at_back(const Constraint& constraint) const;
  ChainUsed& chain_used(int chain);
  Group& group(Place place);
  void group_inner_places();
  void group_bars();
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
  std::vector<Bar> bars_;            // by place, kind, begin
  std::optional<Corridors> chains_;  // made for the first traversal to be barred
  std::vector<ChainUsed> chains_used_;
  Place only_rest_ = kNoPlace;
  Time latest_rest_ = kNever;
};

}  // namespace grove::detail
