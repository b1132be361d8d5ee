// SPDX-License-Identifier: MIT
// Relaxed rows: the constraints that couple the agents, with their multipliers and directions.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "lagrangian/finish_time_conflicts.h"
#include "lagrangian/multipliers.h"
#include "lagrangian/occupancy_counts.h"

namespace grove::detail {

// Set of relaxed rows: in any plan at most one agent uses a row, and it uses it once (proof: head
// of the .cpp). An agent pays a row's multiplier for using it. One thread at a time, and no thread
// may read multipliers() in the meantime.
class RelaxedRows {
 public:
  // `world` must outlive this.
  RelaxedRows(const World& world, int agents);

  const Multipliers& multipliers() const { return multipliers_; }

  // Adds a row with multiplier 0. For a collision, an existing row stays as it is.
  void add(const Collision& collision);
  void add(const FinishTimePair& pair);
  // Whether a row forbids that both agents finish by these times.
  bool has(const FinishTimePair& pair) const;

  // Sets the direction of each row: its uses by `paths` minus 1, plus `memory` times the old
  // direction; not below 0 if the multiplier is 0. Returns the squared length of the direction.
  double update_direction(std::span<const Path> paths, const OccupancyCounts& occupancy,
                          double memory);
  // Moves each multiplier by `step` times its direction, within 0 .. 64 steps.
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
