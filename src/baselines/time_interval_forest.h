// SPDX-License-Identifier: MIT
// Leg planner of MGCBS (Tang et al., IJCAI 2024): one tree of time intervals for each safe interval
// of a goal, which serves every leg to that interval.
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/legs.h"

namespace grove::detail {

// The method is described at the head of time_interval_forest.cpp.
class TimeIntervalForest : public Legs {
 public:
  // `world` must outlive this object.
  explicit TimeIntervalForest(const World& world) : world_(world) {}

  void begin(const AgentStops& stops, const SafeIntervals& intervals,
             std::span<const Constraint> constraints) override;
  Time arrival(Cell from, Time time, Target target, const Limits& limits) override;
  void append(Cell from, Time time, Target target, Path& path) override;
  std::int64_t expanded() const override { return expanded_; }

 private:
  // An agent that is on `cell` at a time in [begin, end] needs at least `steps` steps to the
  // target. The first of them leads into the piece `next`; kNone for a piece in the target.
  struct Piece {
    Cell cell;
    Time begin;
    Time end;  // inclusive; kNever: forever
    Time steps;
    std::int32_t next;
  };
  struct Tree {
    std::vector<Piece> pieces;           // in ascending order of steps
    std::vector<std::int32_t> by_cell;   // indices in pieces, sorted by cell and `begin`
    std::vector<std::int32_t> first_of;  // by cell: index of its first piece in by_cell
  };
  // A move, and the arrival times [begin, end] at which it is forbidden.
  struct BarredMove {
    Cell to;
    Cell from;
    Time begin;
    Time end;
  };
  // Safe times [begin, end] of a cell that no piece covers yet. The gaps of a cell form a list.
  struct Gap {
    Time begin;
    Time end;
    std::int32_t next;
  };

  const Tree* tree_to(Target target, const Limits& limits);
  bool grow(Tree& tree, int slot, const Limits& limits);
  void reach_by_move(Tree& tree, Cell from, std::int32_t piece);
  void cover(Tree& tree, Cell cell, Time begin, Time end, std::int32_t next);
  void open_gaps(Cell cell);
  void sort_pieces(Tree& tree) const;
  const Piece* find(const Tree& tree, Cell cell, Time time) const;

  static constexpr std::int32_t kNone = -1;
  static constexpr std::int32_t kUnseen = -2;

  const World& world_;
  std::int64_t expanded_ = 0;

  // Set by begin().
  const SafeIntervals* intervals_ = nullptr;
  std::vector<BarredMove> barred_moves_;  // sorted by (to, from, begin)
  std::vector<Tree> trees_;               // the first used_ are in use
  std::size_t used_ = 0;
  std::vector<std::int32_t> tree_of_;  // by slot: its tree, or kNone

  // State of the tree under construction.
  std::vector<Gap> gaps_;
  std::vector<std::int32_t> first_gap_;  // by cell
};

}  // namespace grove::detail
