// SPDX-License-Identifier: MIT
// When an agent may be where: constraints turned into intervals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grove/planning/chains.h"
#include "grove/planning/constraint.h"
#include "grove/planning/reservations.h"

namespace grove {

// A cell together with a range of times at which the agent may be there, and what is known of how
// it came. It may always wait inside: constraints bar cells and moves, never waits.
struct SafeInterval {
  Cell cell = kNoCell;
  Time begin = 0;
  Time end = kNever;           // inclusive; kNever: for ever
  Time last_arrival = kNever;  // whoever arrives later is in another interval
  std::uint8_t copy = 0;       // of the cell, see SafeIntervals
  bool may_rest = false;       // for ever
  // With reservations: who was here before moves there at `begin`.
  Cell left_for = kNoCell;
};

// The safe intervals of all cells under one list of constraints. Most cells have no constraint and
// take no memory but a number: their one interval, all of time, is the *slot* with the number of
// the cell. The intervals of the other cells are the slots from cell_count() on, those of one cell
// in a row and in order of time. Reused from list to list; O(constraints) each time but for
// sorting, and for the length of the chains that may not be traversed.
//
// With reservations instead of constraints the intervals of a cell are made when it is first seen:
// see() must come before any other question about a cell. With constraints it does nothing.
//
// One arrival, one slot; a slot keeps what an arrival leads to:
//
// - *No rest by t.* If the interval [b, inf) of a cell has b <= t, it is two overlapping slots: who
//   arrives at t or earlier may be there for as long as it likes, but not for ever; who arrives
//   later may rest.
// - *No traversal.* The inner cells of a chain with such a constraint have all their slots in two
//   or three *copies*. Who enters the chain at one of its ends gets the copy of that end and keeps
//   it until it leaves, and the constraint bars a move out of one copy only. The last copy bars
//   none: it is that of an end whose traversals are free, and of the start at time 0.
class SafeIntervals {
 public:
  // `grid` must outlive this.
  explicit SafeIntervals(const Grid& grid);

  // Replaces the constraints. They may come in any order, overlap and repeat. Throws
  // std::invalid_argument for a cell outside the grid, a move from a cell to itself, or a traversal
  // of what is no chain.
  void assign(std::span<const Constraint> constraints);
  // Bars what would collide with a reserved path. `reservations` must stay as they are until the
  // next assign().
  void assign(const Reservations& reservations);

  void see(Cell cell) {
    if (reservations_ && group_of_[cell] == kNoGroup) look_up(cell);
  }
  // There will not be more slots than this.
  int slot_limit() const { return slot_limit_; }
  int slot_count() const { return cells_ + static_cast<int>(intervals_.size()); }
  Cell cell_of(int slot) const { return slot < cells_ ? slot : interval(slot).cell; }
  Time begin_of(int slot) const { return slot < cells_ ? 0 : interval(slot).begin; }
  Time end_of(int slot) const { return slot < cells_ ? kNever : interval(slot).end; }
  // Whoever comes to the cell later is in another slot.
  Time last_arrival(int slot) const {
    return slot < cells_ ? kNever : interval(slot).last_arrival;
  }
  // May the agent, having arrived in this slot, stay for ever? The time of kRestBy is not looked
  // at.
  bool may_rest(int slot) const {
    return (only_rest_ == kNoCell || cell_of(slot) == only_rest_) &&
           (slot < cells_ || interval(slot).may_rest);
  }
  // Can all that another copy of this slot can do, at the same time, be done from here?
  bool is_free_of_traversals(int slot) const { return copy_of(slot) == kFree; }

  // No constraint at all bars the cell or a move to it, nor has it copies.
  bool unconstrained(Cell cell) const { return group_of_[cell] == kNoGroup; }
  // The slots of a cell: first_slot(cell) .. end_slot(cell) - 1, perhaps none.
  int first_slot(Cell cell) const {
    return unconstrained(cell) ? cell : groups_[group_of_[cell]].first_slot;
  }
  int end_slot(Cell cell) const {
    return unconstrained(cell) ? cell + 1 : groups_[group_of_[cell]].end_slot;
  }
  // Where an agent is that starts on `cell` at time 0; -1: barred.
  int start_slot(Cell cell) const;
  // The begin of the slot of `cell` in which the agent may rest; kNever: there is none.
  Time rest_begin(Cell cell) const;
  // The last time at which the agent may be on `cell`; -1: never.
  Time last_time(Cell cell) const {
    return first_slot(cell) == end_slot(cell) ? -1 : end_of(end_slot(cell) - 1);
  }
  // When the slot of the same copy of the cell after `slot` begins; kNever if there is none.
  Time next_begin(int slot) const;

  // By when the agent must have come to rest (kRestBy); kNever: no matter.
  Time latest_rest() const { return latest_rest_; }
  // The only cell to rest on, kNoCell: no matter. Not a cell at all if there are two such.
  Cell only_rest() const { return only_rest_; }

  // The first time from `earliest` on at which an agent in `from_slot` is not barred from moving to
  // `to`; later than kNever when there is none. Whether `to` is safe then is another matter.
  // Not with reservations.
  Time first_move(int from_slot, Cell to, Time earliest) const;
  // The last time up to `latest` at which it is not barred; negative when there is none.
  Time last_move(int from_slot, Cell to, Time latest) const;

  // Calls arrive(slot, cell, time) for each slot next to `slot` that an agent in it at `from_time`
  // can move to, with the first time at which it can be there.
  template <class Arrive>
  void for_each_move(const Grid& grid, int slot, Time from_time, Arrive arrive) {
    const Cell cell = cell_of(slot);
    for (Cell next : grid.neighbors(cell)) {
      see(next);
      if (unconstrained(next))
        arrive(next, next, from_time + 1);
      else
        enter_intervals(slot, cell, from_time, next, arrive);
    }
  }

 private:
  static constexpr std::int32_t kNoGroup = -1;
  static constexpr std::int32_t kNoCopies = -1;
  static constexpr Cell kNowhere = -2;
  // Copies of the inner cells of a chain.
  static constexpr std::uint8_t kFromFront = 0;
  static constexpr std::uint8_t kFromBack = 1;
  static constexpr std::uint8_t kFree = 2;  // and of cells without copies

  // A constraint as it is kept: times barred on a cell, times by which none may have come to rest,
  // or a barred move to the cell, perhaps from one copy only.
  struct Bar {
    enum class Kind : std::uint8_t { kCell, kRest, kMove };
    Cell cell;
    Cell from;
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
  // What is known of one cell: slots, and positions in bars_.
  struct Group {
    Cell cell;
    std::int32_t first_slot = 0;
    std::int32_t end_slot = 0;
    std::int32_t first_bar = 0;
    std::int32_t first_move = 0;  // the barred moves to the cell come last
    std::int32_t end_move = 0;
    std::int32_t chain = kNoCopies;  // in chains_used_: whose inner cell it is
    Cell front = kNoCell;            // the front of that chain, if next to it
  };

  template <class Arrive>
  void enter_intervals(int from_slot, Cell from, Time from_time, Cell to, Arrive arrive) const {
    const Time last_arrival = end_of(from_slot) + 1;
    const Group& group = groups_[group_of_[to]];
    auto [slot, end_of_cell] = slots_entered(group, from_slot, from);
    for (slot = first_ending_after(slot, end_of_cell, from_time); slot < end_of_cell; ++slot) {
      const Time begin = begin_of(slot);
      const Time end = std::min(interval(slot).last_arrival, last_arrival);
      if (begin > last_arrival) break;
      Time time = std::max(begin, from_time + 1);
      if (!reservations_)
        time = first_move(from_slot, to, time);
      else if (time == begin && interval(slot).left_for == from)
        continue;  // head-on; and later `from` is not safe any more
      if (time <= end) arrive(slot, to, time);
    }
  }

  struct Range {
    int first;
    int end;
  };
  // The slots that a move from `from` may lead into.
  Range slots_entered(const Group& to, int from_slot, Cell from) const {
    if (to.chain == kNoCopies) return {to.first_slot, to.end_slot};
    const ChainUsed& chain = chains_used_[to.chain];
    // A neighbor with copies is an inner cell of the same chain.
    if (has_copies(from)) return slots_of_copy(to, interval(from_slot).copy);
    return slots_of_copy(to, from == to.front ? chain.from_front : chain.from_back);
  }
  Range slots_of_copy(const Group& group, std::uint8_t copy) const;
  bool has_copies(Cell cell) const {
    return !unconstrained(cell) && groups_[group_of_[cell]].chain != kNoCopies;
  }
  std::uint8_t copy_of(int slot) const { return slot < cells_ ? kFree : interval(slot).copy; }

  const SafeInterval& interval(int slot) const { return intervals_[slot - cells_]; }
  // Of some slots of one cell and copy, in a row.
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
    return bar.from == cell_of(from_slot) && bar.begin <= time && time <= bar.end &&
           (bar.copy == kFree || bar.copy == copy_of(from_slot));
  }
  void look_up(Cell cell);
  void forget();
  void check(const Constraint& constraint);
  void keep(const Constraint& constraint);
  void keep_bar(const Constraint& constraint);
  void keep_rest_by(const Constraint& constraint);
  void keep_traversal(const Constraint& constraint);
  bool leaves_at_front(const Constraint& constraint) const;
  bool leaves_at_back(const Constraint& constraint) const;
  ChainUsed& chain_used(int chain);
  Group& group(Cell cell);
  void group_inner_cells();
  void group_bars();
  void add_slots(Group& group);
  void add_intervals(const Group& group, std::uint8_t copy);
  void add_unending_interval(const Group& group, Time begin, std::uint8_t copy);

  const Grid& grid_;
  Cell cells_;
  int slot_limit_ = 0;
  const Reservations* reservations_ = nullptr;
  std::vector<std::int32_t> group_of_;  // by cell
  std::vector<Group> groups_;
  std::vector<SafeInterval> intervals_;
  std::vector<Bar> bars_;         // by cell, kind, begin
  std::optional<Chains> chains_;  // made for the first traversal to be barred
  std::vector<ChainUsed> chains_used_;
  Cell only_rest_ = kNoCell;
  Time latest_rest_ = kNever;
};

}  // namespace grove
