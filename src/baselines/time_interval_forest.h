// SPDX-License-Identifier: MIT
// The bottom of MGCBS (Tang et al., IJCAI 2024): one tree of time intervals for each goal's safe
// interval, which answers for every leg to it.
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/legs.h"

namespace grove::detail {

// The essay is at the head of time_interval_forest.cpp.
class TimeIntervalForest : public Legs {
 public:
  // `world` must outlive this.
  explicit TimeIntervalForest(const World& world) : world_(world) {}

  void begin(const AgentStops& stops, const SafeIntervals& intervals,
             std::span<const Constraint> constraints) override;
  Time arrival(Cell from, Time time, Target target, const Limits& limits) override;
  void append(Cell from, Time time, Target target, Path& path) override;
  std::int64_t expanded() const override { return expanded_; }

 private:
  // Whoever is on `cell` at a time in [begin, end] needs `steps` steps to the target, the first of
  // them into the piece `next`.
  struct Piece {
    Cell cell;
    Time begin;
    Time end;  // inclusive; kNever: for ever
    Time steps;
    std::int32_t next;
  };
  struct Tree {
    std::vector<Piece> pieces;           // by steps
    std::vector<std::int32_t> by_cell;   // pieces, by cell and begin
    std::vector<std::int32_t> first_of;  // by cell: where its pieces begin in by_cell
  };
  // Times at which a move is barred, by arrival.
  struct BarredMove {
    Cell to;
    Cell from;
    Time begin;
    Time end;
  };
  // Safe times of a cell that are in no piece yet.
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

  // Of begin().
  const SafeIntervals* intervals_ = nullptr;
  std::vector<BarredMove> barred_moves_;  // by (to, from, begin)
  std::vector<Tree> trees_;               // those in use first
  std::size_t used_ = 0;
  std::vector<std::int32_t> tree_of_;  // by slot: its tree, if it is grown

  // Of the tree being grown.
  std::vector<Gap> gaps_;
  std::vector<std::int32_t> first_gap_;  // by cell
};

}  // namespace grove::detail
