// SPDX-License-Identifier: MIT
// When an agent may be where: constraints turned into intervals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/planning/constraint.h"
#include "grove/planning/reservations.h"

namespace grove {

// A cell together with a longest range of times at which the agent may be there. It may always wait
// inside: constraints bar cells and moves, never waits.
struct SafeInterval {
  Cell cell = kNoCell;
  Time begin = 0;
  Time end = kNever;  // inclusive; kNever: for ever
  // With reservations: who was here before moves there at `begin`.
  Cell left_for = kNoCell;
};

// The safe intervals of all cells under one list of constraints. Most cells have no constraint and
// take no memory but a number: their one interval, all of time, is the *slot* with the number of
// the cell. The intervals of the other cells are the slots from cell_count() on, those of one cell
// in a row and in order of time. Reused from list to list; O(constraints) each time but for
// sorting.
//
// With reservations instead of constraints the intervals of a cell are made when it is first seen:
// see() must come before any other question about a cell. With constraints it does nothing.
class SafeIntervals {
 public:
  explicit SafeIntervals(const Grid& grid);

  // Replaces the constraints. They may come in any order, overlap and repeat. Throws
  // std::invalid_argument for a cell outside the grid or a move from a cell to itself.
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

  // No constraint at all bars the cell or a move to it.
  bool unconstrained(Cell cell) const { return group_of_[cell] == kNoGroup; }
  // The slots of a cell: first_slot(cell) .. end_slot(cell) - 1, perhaps none.
  int first_slot(Cell cell) const {
    return unconstrained(cell) ? cell : groups_[group_of_[cell]].first_slot;
  }
  int end_slot(Cell cell) const {
    return unconstrained(cell) ? cell + 1 : groups_[group_of_[cell]].end_slot;
  }
  // The slot of `cell` that contains `time`, or -1.
  int slot_at(Cell cell, Time time) const;
  // The slot of `cell` that never ends, or -1.
  int last_slot(Cell cell) const { return slot_at(cell, kNever); }
  // When the slot of the same cell after `slot` begins; kNever if there is none.
  Time next_begin(int slot) const;

  // The first time from `earliest` on at which the move from -> to is not barred; later than kNever
  // when there is none. Whether `to` is safe then is another matter. Not with reservations.
  Time first_move(Cell from, Cell to, Time earliest) const;

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
  // The constraints on one cell and the moves to it.
  struct Group {
    Cell cell;
    int first_slot;
    int end_slot;
    int first_move;  // barred moves to the cell: positions in sorted_
    int end_move;
  };
  static constexpr std::int32_t kNoGroup = -1;

  template <class Arrive>
  void enter_intervals(int from_slot, Cell from, Time from_time, Cell to, Arrive arrive) const {
    const Time last_arrival = end_of(from_slot) + 1;
    const int end_of_cell = end_slot(to);
    for (int slot = first_slot_after(to, from_time); slot < end_of_cell; ++slot) {
      const Time begin = begin_of(slot);
      const Time end = std::min(end_of(slot), last_arrival);
      if (begin > last_arrival) break;
      Time time = std::max(begin, from_time + 1);
      if (!reservations_)
        time = first_move(from, to, time);
      else if (time == begin && interval(slot).left_for == from)
        continue;  // head-on; and later `from` is not safe any more
      if (time <= end) arrive(slot, to, time);
    }
  }

  const SafeInterval& interval(int slot) const { return intervals_[slot - cells_]; }
  // The first slot of a constrained cell that ends after `time`, or the end of its slots.
  int first_slot_after(Cell cell, Time time) const {
    const Group& group = groups_[group_of_[cell]];
    int first = group.first_slot;
    for (int many = group.end_slot - first; many > 0;) {
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
  void look_up(Cell cell);
  void sort_valid(std::span<const Constraint> constraints);
  void forget_groups();
  // Both read sorted_ from `position` and return where the next kind or cell begins.
  std::size_t add_intervals(Cell cell, std::size_t position);
  std::size_t skip_moves(Cell cell, std::size_t position) const;

  Cell cells_;
  int slot_limit_ = 0;
  const Reservations* reservations_ = nullptr;
  std::vector<std::int32_t> group_of_;  // by cell
  std::vector<Group> groups_;
  std::vector<SafeInterval> intervals_;
  std::vector<Constraint> sorted_;  // by cell; its bars, then barred moves to it; each by begin
};

}  // namespace grove
