// SPDX-License-Identifier: MIT
// Set of relaxed rows: constraints that couple the agents, with their multipliers and directions of
// ascent.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "lagrangian/finish_time_conflicts.h"
#include "lagrangian/multipliers.h"
#include "lagrangian/occupancy_counts.h"

namespace grove::detail {

// Relaxed rows (relaxed_row.h), each with a multiplier, which an agent's path pays for each use of
// the row, and a direction for the subgradient method. While one thread changes the object, no
// other thread may use it or multipliers().
class RelaxedRows {
 public:
  // `world` must outlive this object.
  RelaxedRows(const World& world, int agents);

  const Multipliers& multipliers() const { return multipliers_; }

  // Adds a row with multiplier 0. add(collision) does nothing if the row exists.
  void add(const Collision& collision);
  void add(const FinishTimePair& pair);
  // True if an existing row implies that not both agents finish by these times.
  bool has(const FinishTimePair& pair) const;

  // Sets the direction of each row to its subgradient, which is its number of uses by `paths` minus
  // 1, plus `memory` times its old direction. If the multiplier is 0, neither the subgradient nor
  // the direction is below 0. `occupancy` must contain the counts of `paths`. Returns the squared
  // norm of the direction.
  double update_direction(std::span<const Path> paths, const OccupancyCounts& occupancy,
                          double memory);
  // Adds `step` times its direction to each multiplier, clamps the result to the cost of 0 to 64
  // time steps, and rounds it to an integer amount.
  void take_step(double step);

 private:
  using RowId = Multipliers::RowId;
  using Kind = RelaxedRow::Kind;
  struct RowState {
    std::int32_t used = 0;
    double exact_multiplier = 0;
    double direction = 0;
  };

  RowId add_row(const RelaxedRow& row);
  void add_row(std::unordered_map<std::uint64_t, RowId>& rows, std::uint64_t key,
               const RelaxedRow& row);
  std::uint64_t place_key(Place place, Time time) const;
  std::uint64_t edge_key(Place from, Place to, Time arrival) const;
  void count_uses(std::span<const Path> paths, const OccupancyCounts& occupancy);
  void count_moves(const Path& path, Time end);
  void count_move(Place from, Place to, Time arrival);
  void use_edge(Place from, Place to, Time arrival);

  const World& world_;
  Multipliers multipliers_;
  std::vector<RowState> row_states_;  // by row
  std::unordered_map<std::uint64_t, RowId> place_rows_;
  std::unordered_map<std::uint64_t, RowId> edge_rows_;
  std::vector<std::uint8_t> has_edge_rows_;                            // by place
  std::unordered_map<std::uint64_t, std::vector<RowId>> finish_rows_;  // by pair of agents
};

}  // namespace grove::detail
