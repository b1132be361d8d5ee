// SPDX-License-Identifier: MIT
#include "grove/planning/safe_intervals.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace grove {

SafeIntervals::SafeIntervals(const Grid& grid)
    : grid_(grid),
      cells_(grid.cell_count()),
      slot_limit_(cells_),
      group_of_(grid.cell_count(), kNoGroup) {}

void SafeIntervals::assign(std::span<const Constraint> constraints) {
  forget();
  for (const Constraint& c : constraints) check(c);
  for (const Constraint& c : constraints) keep(c);
  std::ranges::sort(bars_, [](const Bar& a, const Bar& b) {
    return std::tuple(a.cell, a.kind, a.begin) < std::tuple(b.cell, b.kind, b.begin);
  });
  group_inner_cells();
  group_bars();
  for (Group& group : groups_) add_slots(group);
  slot_limit_ = slot_count();
}

void SafeIntervals::assign(const Reservations& reservations) {
  forget();
  reservations_ = &reservations;
  // k stays leave at most k + 1 intervals.
  slot_limit_ = cells_ + static_cast<int>(2 * reservations.count());
}

void SafeIntervals::look_up(Cell cell) {
  const std::span<const Reservations::Stay> stays = reservations_->stays(cell);
  if (stays.empty()) return;
  Group g{.cell = cell};
  g.first_slot = slot_count();
  Time safe_from = 0;
  Cell left_for = kNoCell;
  for (const Reservations::Stay& stay : stays) {
    if (safe_from < stay.first)
      intervals_.push_back(
          {cell, safe_from, stay.first - 1, stay.first - 1, kFree, false, left_for});
    safe_from = stay.last + 1;
    left_for = stay.next;
  }
  if (safe_from < kNever)
    intervals_.push_back({cell, safe_from, kNever, kNever, kFree, true, left_for});
  g.end_slot = slot_count();
  group_of_[cell] = static_cast<std::int32_t>(groups_.size());
  groups_.push_back(g);
}

void SafeIntervals::forget() {
  for (const Group& group : groups_) group_of_[group.cell] = kNoGroup;
  reservations_ = nullptr;
  groups_.clear();
  intervals_.clear();
  bars_.clear();
  chains_used_.clear();
  only_rest_ = kNoCell;
  latest_rest_ = kNever;
}

void SafeIntervals::check(const Constraint& c) {
  const auto on_grid = [this](Cell cell) { return cell >= 0 && cell < cells_; };
  const bool has_from = c.is_move() || c.kind == ConstraintKind::kNoTraversal;
  if (!on_grid(c.cell) || (has_from && (!on_grid(c.from) || c.from == c.cell)))
    throw std::invalid_argument("a constraint must bar a cell of the grid or a move on it");
  if (is_about_sequence(c))
    throw std::invalid_argument("a constraint on the sequence is none on the path");
  if (c.kind != ConstraintKind::kNoTraversal) return;
  if (!chains_) chains_.emplace(grid_);
  if (!leaves_at_front(c) && !leaves_at_back(c))
    throw std::invalid_argument("a traversal must leave a chain for one of its ends");
}

bool SafeIntervals::leaves_at_front(const Constraint& c) const {
  const int chain = chains_->chain_of(c.from);
  return chain != Chains::kNoChain && chains_->position(c.from) == 1 &&
         chains_->cells(chain).front() == c.cell;
}

bool SafeIntervals::leaves_at_back(const Constraint& c) const {
  const int chain = chains_->chain_of(c.from);
  if (chain == Chains::kNoChain) return false;
  const auto cells = chains_->cells(chain);
  return cells[cells.size() - 2] == c.from && cells.back() == c.cell;
}

void SafeIntervals::keep(const Constraint& c) {
  const bool is_ever = c.end >= std::max(c.begin, 0);
  switch (c.kind) {
    case ConstraintKind::kBar:
      if (is_ever) keep_bar(c);
      break;
    case ConstraintKind::kNoRestBy:
      if (c.end >= 0) bars_.push_back({c.cell, kNoCell, 0, c.end, Bar::Kind::kRest, kFree});
      break;
    case ConstraintKind::kRestBy:
      keep_rest_by(c);
      break;
    case ConstraintKind::kNoTraversal:
      if (is_ever) keep_traversal(c);
      break;
    case ConstraintKind::kStopIs:
    case ConstraintKind::kStopIsNot:
      break;  // none on the path: check() has refused it
  }
}

void SafeIntervals::keep_bar(const Constraint& c) {
  const Bar::Kind kind = c.is_move() ? Bar::Kind::kMove : Bar::Kind::kCell;
  bars_.push_back({c.cell, c.from, c.begin, c.end, kind, kFree});
}

void SafeIntervals::keep_rest_by(const Constraint& c) {
  only_rest_ = only_rest_ == kNoCell || only_rest_ == c.cell ? c.cell : kNowhere;
  latest_rest_ = std::min(latest_rest_, c.end);
}

void SafeIntervals::keep_traversal(const Constraint& c) {
  ChainUsed& used = chain_used(chains_->chain_of(c.from));
  const bool at_back = leaves_at_back(c);
  (at_back ? used.from_front = kFromFront : used.from_back = kFromBack);
  const std::uint8_t barred = at_back ? kFromFront : kFromBack;
  bars_.push_back({c.cell, c.from, c.begin, c.end, Bar::Kind::kMove, barred});
}

SafeIntervals::ChainUsed& SafeIntervals::chain_used(int chain) {
  const auto known = std::ranges::find(chains_used_, chain, &ChainUsed::chain);
  return known != chains_used_.end() ? *known : chains_used_.emplace_back(chain);
}

SafeIntervals::Group& SafeIntervals::group(Cell cell) {
  if (unconstrained(cell)) {
    group_of_[cell] = static_cast<std::int32_t>(groups_.size());
    groups_.push_back({.cell = cell});
  }
  return groups_[group_of_[cell]];
}

void SafeIntervals::group_inner_cells() {
  for (std::size_t used = 0; used < chains_used_.size(); ++used) {
    const auto cells = chains_->cells(chains_used_[used].chain);
    for (const Cell inner : cells.subspan(1, cells.size() - 2))
      group(inner).chain = static_cast<std::int32_t>(used);
    group(cells[1]).front = cells.front();
  }
}

void SafeIntervals::group_bars() {
  const auto end_of_kind = [this](std::size_t i, Cell cell, Bar::Kind last) {
    while (i < bars_.size() && bars_[i].cell == cell && bars_[i].kind <= last) ++i;
    return i;
  };
  for (std::size_t i = 0; i < bars_.size();) {
    const Cell cell = bars_[i].cell;
    Group& g = group(cell);
    g.first_bar = static_cast<std::int32_t>(i);
    i = end_of_kind(i, cell, Bar::Kind::kRest);
    g.first_move = static_cast<std::int32_t>(i);
    i = end_of_kind(i, cell, Bar::Kind::kMove);
    g.end_move = static_cast<std::int32_t>(i);
  }
}

void SafeIntervals::add_slots(Group& group) {
  group.first_slot = slot_count();
  if (group.chain != kNoCopies) {
    const ChainUsed& used = chains_used_[group.chain];
    if (used.from_front != kFree) add_intervals(group, used.from_front);
    if (used.from_back != kFree) add_intervals(group, used.from_back);
  }
  add_intervals(group, kFree);
  group.end_slot = slot_count();
}

void SafeIntervals::add_intervals(const Group& group, std::uint8_t copy) {
  Time safe_from = 0;
  for (int i = group.first_bar; i < group.first_move; ++i) {
    const Bar& bar = bars_[i];
    if (bar.kind != Bar::Kind::kCell) break;
    if (safe_from < bar.begin)
      intervals_.push_back(
          {group.cell, safe_from, bar.begin - 1, bar.begin - 1, copy, false, kNoCell});
    safe_from = std::max(safe_from, std::min(bar.end, kNever) + 1);
  }
  if (safe_from < kNever) add_unending_interval(group, safe_from, copy);
}

void SafeIntervals::add_unending_interval(const Group& group, Time begin, std::uint8_t copy) {
  Time no_rest_by = -1;
  for (int i = group.first_bar; i < group.first_move; ++i)
    if (bars_[i].kind == Bar::Kind::kRest) no_rest_by = std::max(no_rest_by, bars_[i].end);
  no_rest_by = std::min(no_rest_by, kNever);
  if (begin <= no_rest_by)
    intervals_.push_back({group.cell, begin, kNever, no_rest_by, copy, false, kNoCell});
  if (const Time rest_from = std::max(begin, no_rest_by + 1); rest_from < kNever)
    intervals_.push_back({group.cell, rest_from, kNever, kNever, copy, true, kNoCell});
}

SafeIntervals::Range SafeIntervals::slots_of_copy(const Group& group, std::uint8_t copy) const {
  const ChainUsed& used = chains_used_[group.chain];
  const int before =
      static_cast<int>(copy > used.from_front) + static_cast<int>(copy > used.from_back);
  const int copies =
      1 + static_cast<int>(used.from_front != kFree) + static_cast<int>(used.from_back != kFree);
  const int each = (group.end_slot - group.first_slot) / copies;
  return {group.first_slot + before * each, group.first_slot + (before + 1) * each};
}

int SafeIntervals::start_slot(Cell cell) const {
  if (unconstrained(cell)) return cell;
  const Group& g = groups_[group_of_[cell]];
  const Range slots = has_copies(cell) ? slots_of_copy(g, kFree) : Range{g.first_slot, g.end_slot};
  return slots.first < slots.end && begin_of(slots.first) == 0 ? slots.first : -1;
}

Time SafeIntervals::rest_begin(Cell cell) const {
  for (int slot = first_slot(cell); slot < end_slot(cell); ++slot)
    if (may_rest(slot)) return begin_of(slot);
  return kNever;
}

Time SafeIntervals::next_begin(int slot) const {
  if (slot < cells_ || slot + 1 >= slot_count()) return kNever;
  const SafeInterval& here = interval(slot);
  const SafeInterval& next = interval(slot + 1);
  return next.cell == here.cell && next.copy == here.copy ? next.begin : kNever;
}

Time SafeIntervals::first_move(int from_slot, Cell to, Time earliest) const {
  if (unconstrained(to)) return earliest;
  const Group& group = groups_[group_of_[to]];
  // One pass will do: the bars are in order of their begin.
  for (int i = group.first_move; i < group.end_move; ++i)
    if (bars(bars_[i], from_slot, earliest)) earliest = std::min(bars_[i].end, kNever) + 1;
  return earliest;
}

Time SafeIntervals::last_move(int from_slot, Cell to, Time latest) const {
  if (unconstrained(to)) return latest;
  const Group& group = groups_[group_of_[to]];
  // One pass will do here, too: the bars passed begin later than those to come.
  for (int i = group.end_move - 1; i >= group.first_move; --i)
    if (bars(bars_[i], from_slot, latest)) latest = bars_[i].begin - 1;
  return latest;
}

}  // namespace grove
