// SPDX-License-Identifier: MIT
// The time-interval space forest of MGCBS.
//
// *Problem.* For one safe interval of a goal, find the least number of steps to reach it from each
// cell at each time.
//
// *Method.* Backward breadth-first search in pieces. A piece is a cell and an interval of times
// with the same answer. A piece of k steps at times [b, e] gives k + 1 steps to each neighbour, and
// to the cell itself by waiting, at those times in [b - 1, e - 1] at which the cell is safe, the
// move is not forbidden, and no smaller number is known. So each piece is final when it is made,
// pieces are made in order of their steps, and a cell from which the answer does not depend on the
// time is usually one piece. A tree depends neither on the time when a leg starts nor on the goals
// visited before, so all legs of one low-level call to the same target share it.
//
// *Limits.* If a target interval begins late, waiting for it makes one piece per cell for every
// time step before its start, as in the published code.
#include "baselines/time_interval_forest.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kPiecesPerPoll = 512;

// Returns `time` - 1, or kNever for kNever.
Time before(Time time) {
  return time == kNever ? kNever : time - 1;
}

}  // namespace

void TimeIntervalForest::begin(const AgentStops&, const SafeIntervals& intervals,
                               std::span<const Constraint> constraints) {
  intervals_ = &intervals;
  used_ = 0;
  tree_of_.assign(static_cast<std::size_t>(intervals.slot_count()), kNone);
  barred_moves_.clear();
  for (const Constraint& c : constraints)
    if (c.is_move()) barred_moves_.push_back({c.cell, c.from, c.begin, c.end});
  std::ranges::sort(barred_moves_, {},
                    [](const BarredMove& m) { return std::tuple(m.to, m.from, m.begin); });
}

Time TimeIntervalForest::arrival(Cell from, Time time, Target target, const Limits& limits) {
  const Tree* tree = tree_to(target, limits);
  const Piece* piece = tree ? find(*tree, from, time) : nullptr;
  return piece ? time + piece->steps : kNever;
}

void TimeIntervalForest::append(Cell from, Time time, Target target, Path& path) {
  const Tree* tree = tree_to(target, Limits());
  const Piece* piece = find(*tree, from, time);
  if (!piece) throw std::logic_error("internal error: a leg that was found is missing");
  while (piece->next != kNone) {
    const Time steps = piece->steps;
    piece = &tree->pieces[piece->next];
    ++time;
    GROVE_ASSERT(piece->begin <= time && time <= piece->end && piece->steps == steps - 1,
                 "a step of a leg leads to the next piece while it is valid");
    path.push_back(piece->cell);
  }
}

// Returns the tree of `target`, which is built on first use. Returns nullptr if a limit was
// reached.
const TimeIntervalForest::Tree* TimeIntervalForest::tree_to(Target target, const Limits& limits) {
  std::int32_t& number = tree_of_[target.slot];
  if (number == kNone) {
    if (used_ == trees_.size()) trees_.emplace_back();
    if (!grow(trees_[used_], target.slot, limits)) return nullptr;
    number = static_cast<std::int32_t>(used_++);
  }
  return &trees_[number];
}

bool TimeIntervalForest::grow(Tree& tree, int slot, const Limits& limits) {
  tree.pieces.clear();
  gaps_.clear();
  first_gap_.assign(static_cast<std::size_t>(world_.place_count()), kUnseen);
  cover(tree, intervals_->state_of(slot), intervals_->begin_of(slot), intervals_->end_of(slot),
        kNone);
  for (std::size_t i = 0; i < tree.pieces.size(); ++i) {
    if (i % kPiecesPerPoll == 0 && limits.stop_requested()) return false;
    const Piece piece = tree.pieces[i];
    const auto number = static_cast<std::int32_t>(i);
    cover(tree, piece.cell, std::max(0, piece.begin - 1), before(piece.end), number);
    for (Cell from : world_.neighbors(piece.cell)) reach_by_move(tree, from, number);
  }
  expanded_ += static_cast<std::int64_t>(tree.pieces.size());
  sort_pieces(tree);
  return true;
}

// Covers the neighbour `from` of the piece `next` at the times at which the move into the piece is
// not forbidden.
void TimeIntervalForest::reach_by_move(Tree& tree, Cell from, std::int32_t next) {
  const Piece piece = tree.pieces[next];
  const Time end = before(piece.end);
  Time begin = std::max(0, piece.begin - 1);
  const auto move = [](const BarredMove& m) { return std::pair(m.to, m.from); };
  const std::pair wanted(piece.cell, from);
  for (auto m = std::ranges::lower_bound(barred_moves_, wanted, {}, move);
       m != barred_moves_.end() && move(*m) == wanted; ++m) {
    if (m->end - 1 < begin) continue;
    if (m->begin - 1 > end) break;
    cover(tree, from, begin, m->begin - 2, next);
    if (m->end >= kNever) return;
    begin = m->end;
  }
  cover(tree, from, begin, end, next);
}

// Makes pieces for the safe times in [begin, end] that no piece covers yet.
void TimeIntervalForest::cover(Tree& tree, Cell cell, Time begin, Time end, std::int32_t next) {
  if (begin > end) return;
  if (first_gap_[cell] == kUnseen) open_gaps(cell);
  const Time steps = next == kNone ? 0 : tree.pieces[next].steps + 1;
  std::int32_t previous = kNone;
  const auto link = [&](std::int32_t gap) -> std::int32_t& {
    return gap == kNone ? first_gap_[cell] : gaps_[gap].next;
  };
  for (std::int32_t gap = first_gap_[cell]; gap != kNone; gap = link(previous)) {
    const Gap g = gaps_[gap];
    if (g.begin > end) return;
    if (g.end < begin) {
      previous = gap;
      continue;
    }
    GROVE_ASSERT(tree.pieces.empty() || tree.pieces.back().steps <= steps,
                 "pieces are made in order of their steps");
    tree.pieces.push_back({cell, std::max(begin, g.begin), std::min(end, g.end), steps, next});
    if (g.begin < begin) {  // a part before `begin` remains
      gaps_[gap].end = begin - 1;
      previous = gap;
      if (g.end > end) {
        gaps_.push_back({end + 1, g.end, g.next});
        gaps_[gap].next = static_cast<std::int32_t>(gaps_.size()) - 1;
        return;
      }
    } else if (g.end > end) {  // a part after `end` remains
      gaps_[gap].begin = end + 1;
      return;
    } else {
      link(previous) = g.next;
    }
  }
}

void TimeIntervalForest::open_gaps(Cell cell) {
  std::int32_t next = kNone;
  for (int slot = intervals_->end_slot(cell) - 1; slot >= intervals_->first_slot(cell); --slot) {
    gaps_.push_back({intervals_->begin_of(slot), intervals_->end_of(slot), next});
    next = static_cast<std::int32_t>(gaps_.size()) - 1;
  }
  first_gap_[cell] = next;
}

void TimeIntervalForest::sort_pieces(Tree& tree) const {
  const auto count = static_cast<std::int32_t>(tree.pieces.size());
  tree.first_of.assign(static_cast<std::size_t>(world_.place_count()) + 1, 0);
  for (const Piece& piece : tree.pieces) ++tree.first_of[piece.cell + 1];
  for (Cell cell = 0; cell < world_.place_count(); ++cell)
    tree.first_of[cell + 1] += tree.first_of[cell];
  tree.by_cell.resize(tree.pieces.size());
  std::vector<std::int32_t> free = tree.first_of;
  for (std::int32_t i = 0; i < count; ++i) tree.by_cell[free[tree.pieces[i].cell]++] = i;
  for (Cell cell = 0; cell < world_.place_count(); ++cell) {
    std::sort(tree.by_cell.begin() + tree.first_of[cell],
              tree.by_cell.begin() + tree.first_of[cell + 1], [&](std::int32_t a, std::int32_t b) {
                return tree.pieces[a].begin < tree.pieces[b].begin;
              });
    GROVE_ASSERT(std::adjacent_find(tree.by_cell.begin() + tree.first_of[cell],
                                    tree.by_cell.begin() + tree.first_of[cell + 1],
                                    [&](std::int32_t a, std::int32_t b) {
                                      return tree.pieces[a].end >= tree.pieces[b].begin;
                                    }) == tree.by_cell.begin() + tree.first_of[cell + 1],
                 "the pieces of a cell do not overlap");
  }
}

// Returns the piece of `cell` that contains `time`, or nullptr if the target cannot be reached from
// `cell` at that time.
const TimeIntervalForest::Piece* TimeIntervalForest::find(const Tree& tree, Cell cell,
                                                          Time time) const {
  const auto first = tree.by_cell.begin() + tree.first_of[cell];
  const auto end = tree.by_cell.begin() + tree.first_of[cell + 1];
  const auto after = std::upper_bound(
      first, end, time, [&](Time t, std::int32_t piece) { return t < tree.pieces[piece].begin; });
  if (after == first) return nullptr;
  const Piece& piece = tree.pieces[*(after - 1)];
  return time <= piece.end ? &piece : nullptr;
}

}  // namespace grove::detail
