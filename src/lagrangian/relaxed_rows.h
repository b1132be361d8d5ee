// SPDX-License-Identifier: MIT
// What all agents together must obey, and how dear that should be.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "lagrangian/finish_time_conflicts.h"
#include "lagrangian/multipliers.h"
#include "lagrangian/occupancy_counts.h"

namespace grove::detail {

// Rows: of each at most one agent uses it once, in any plan (the argument is at the head of the
// .cpp). Each has a multiplier, which whoever uses it pays: it is in the tariff. For one thread at
// a time, and nobody may read the tariff meanwhile.
class RelaxedRows {
 public:
  // `world` must outlive this.
  RelaxedRows(const World& world, int agents);

  const Multipliers& multipliers() const { return multipliers_; }

  // New rows have multiplier 0. Those that there are already stay.
  void add(const Collision& collision);
  void add(const FinishTimeConflict& pair);
  // Is there a row that says that these two cannot both finish by these times?
  bool has(const FinishTimeConflict& pair) const;

  // Sets the direction of each row: what these paths use it beyond once, and so much of the old
  // direction. Returns the squared length of all.
  double turn(std::span<const Path> paths, const OccupancyCounts& encounters, double memory);
  // Multipliers go so far in their directions, but not below 0.
  void go(double step);

 private:
  using RowId = Multipliers::RowId;
  using Kind = RelaxedRow::Kind;
  struct Course {
    std::int32_t used = 0;
    double exact_multiplier = 0;
    double direction = 0;
  };

  RowId add_row(const RelaxedRow& row);
  void add_row(std::unordered_map<std::uint64_t, RowId>& rows, std::uint64_t key,
               const RelaxedRow& row);
  std::uint64_t place_key(Place place, Time time) const;
  std::uint64_t edge_key(Place from, Place to, Time arrival) const;
  void count_uses(std::span<const Path> paths, const OccupancyCounts& encounters);
  void count_moves(const Path& path, Time end);
  void count_move(Place from, Place to, Time arrival);
  void use_edge(Place from, Place to, Time arrival);

  const World& world_;
  Multipliers multipliers_;
  std::vector<Course> courses_;  // by row
  std::unordered_map<std::uint64_t, RowId> place_rows_;
  std::unordered_map<std::uint64_t, RowId> edge_rows_;
  std::vector<std::uint8_t> has_edge_rows_;                            // by place
  std::unordered_map<std::uint64_t, std::vector<RowId>> finish_rows_;  // by pair of agents
};

}  // namespace grove::detail
