// SPDX-License-Identifier: MIT
#include "safe_intervals.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace grove {
namespace {

bool in_order(const Constraint& a, const Constraint& b) {
  return std::tuple(a.cell, a.is_move(), a.begin) < std::tuple(b.cell, b.is_move(), b.begin);
}

}  // namespace

SafeIntervals::SafeIntervals(const Grid& grid)
    : cells_(grid.cell_count()), slot_limit_(cells_), group_of_(grid.cell_count(), kNoGroup) {}

void SafeIntervals::assign(std::span<const Constraint> constraints) {
  forget_groups();
  sort_valid(constraints);
  for (std::size_t i = 0; i < sorted_.size();) {
    const Cell cell = sorted_[i].cell;
    Group group{};
    group.cell = cell;
    group.first_slot = slot_count();
    i = add_intervals(cell, i);
    group.end_slot = slot_count();
    group.first_move = static_cast<int>(i);
    i = skip_moves(cell, i);
    group.end_move = static_cast<int>(i);
    group_of_[cell] = static_cast<std::int32_t>(groups_.size());
    groups_.push_back(group);
  }
  slot_limit_ = slot_count();
}

void SafeIntervals::assign(const Reservations& reservations) {
  forget_groups();
  reservations_ = &reservations;
  // k stays leave at most k + 1 intervals.
  slot_limit_ = cells_ + static_cast<int>(2 * reservations.count());
}

void SafeIntervals::look_up(Cell cell) {
  const std::span<const Reservations::Stay> stays = reservations_->stays(cell);
  if (stays.empty()) return;
  Group group{};
  group.cell = cell;
  group.first_slot = slot_count();
  Time safe_from = 0;
  Cell left_for = kNoCell;
  for (const Reservations::Stay& stay : stays) {
    if (safe_from < stay.first) intervals_.push_back({cell, safe_from, stay.first - 1, left_for});
    safe_from = stay.last + 1;
    left_for = stay.next;
  }
  if (safe_from < kNever) intervals_.push_back({cell, safe_from, kNever, left_for});
  group.end_slot = slot_count();
  group_of_[cell] = static_cast<std::int32_t>(groups_.size());
  groups_.push_back(group);
}

void SafeIntervals::forget_groups() {
  for (const Group& group : groups_) group_of_[group.cell] = kNoGroup;
  reservations_ = nullptr;
  groups_.clear();
  intervals_.clear();
  sorted_.clear();
}

void SafeIntervals::sort_valid(std::span<const Constraint> constraints) {
  const auto on_grid = [this](Cell cell) { return cell >= 0 && cell < cells_; };
  for (const Constraint& c : constraints)
    if (!on_grid(c.cell) || (c.is_move() && (!on_grid(c.from) || c.from == c.cell)))
      throw std::invalid_argument("a constraint must bar a cell of the grid or a move on it");
  for (const Constraint& c : constraints)
    if (c.begin <= c.end && c.end >= 0) sorted_.push_back(c);
  std::ranges::sort(sorted_, in_order);
}

std::size_t SafeIntervals::add_intervals(Cell cell, std::size_t position) {
  Time safe_from = 0;
  for (; position < sorted_.size(); ++position) {
    const Constraint& c = sorted_[position];
    if (c.cell != cell || c.is_move()) break;
    if (safe_from < c.begin) intervals_.push_back({cell, safe_from, c.begin - 1});
    safe_from = std::max(safe_from, std::min(c.end, kNever) + 1);
  }
  if (safe_from < kNever) intervals_.push_back({cell, safe_from, kNever});
  return position;
}

std::size_t SafeIntervals::skip_moves(Cell cell, std::size_t position) const {
  while (position < sorted_.size() && sorted_[position].cell == cell) ++position;
  return position;
}

int SafeIntervals::slot_at(Cell cell, Time time) const {
  for (int slot = first_slot(cell); slot < end_slot(cell); ++slot)
    if (begin_of(slot) <= time && time <= end_of(slot)) return slot;
  return -1;
}

Time SafeIntervals::next_begin(int slot) const {
  if (slot < cells_ || slot + 1 >= slot_count()) return kNever;
  return cell_of(slot + 1) == cell_of(slot) ? begin_of(slot + 1) : kNever;
}

Time SafeIntervals::first_move(Cell from, Cell to, Time earliest) const {
  if (unconstrained(to)) return earliest;
  const Group& group = groups_[group_of_[to]];
  // One pass will do: the bars are in order of their begin.
  for (int i = group.first_move; i < group.end_move; ++i) {
    const Constraint& bar = sorted_[i];
    if (bar.from == from && bar.begin <= earliest && earliest <= bar.end)
      earliest = std::min(bar.end, kNever) + 1;
  }
  return earliest;
}

}  // namespace grove
