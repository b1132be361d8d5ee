// SPDX-License-Identifier: MIT
// What all agents together must obey, and what it costs each of them to use it.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "grove/detail/lagrangian/encounters.h"
#include "grove/detail/lagrangian/finish_pairs.h"
#include "grove/detail/lagrangian/penalized_search.h"
#include "grove/detail/lagrangian/penalties.h"

namespace grove::detail {

// Rows: of each at most one agent uses it once, in any plan (the argument is at the head of the
// .cpp). Each has a multiplier, which whoever uses it pays: it is among the penalties. For one
// thread at a time, and nobody may read the penalties meanwhile.
class RelaxedRows {
 public:
  using Amount = Penalties::Amount;

  // `world` must outlive this.
  RelaxedRows(const World& world, int agents);

  const Penalties& penalties() const { return penalties_; }
  // What an agent pays for finishing at a time; 0 beyond the end.
  std::span<const Amount> on_finish(AgentIndex agent) const { return on_finish_[agent]; }
  // What a path costs with all of that.
  Price price(AgentIndex agent, const Path& path) const;
  Price sum_of_multipliers() const { return sum_; }

  // New rows have multiplier 0. Those that there are already stay.
  void add(const Collision& collision);
  void add(const FinishPair& pair);
  // Is there a row that says that these two cannot both finish by these times?
  bool has(const FinishPair& pair) const;
  std::size_t count() const { return rows_.size(); }

  // Sets the direction of each row: what these paths use it beyond once, and so much of the old
  // direction. Returns the squared length of all.
  double turn(std::span<const Path> paths, const Encounters& encounters, double memory);
  // Multipliers go so far in their directions, but not below 0.
  void go(double step);

 private:
  enum class Kind : std::uint8_t { kPlace, kEdge, kFinish };
  struct Row {
    Kind kind = Kind::kPlace;
    std::int32_t a = 0;  // a place, or an agent
    std::int32_t b = 0;  // another; of kPlace: kNoPlace
    Time time = 0;       // of kFinish: by which a finishes
    Time time_b = 0;     // only of kFinish
    std::int32_t used = 0;
    Amount given = 0;  // the multiplier, as it is paid
    double multiplier = 0;
    double direction = 0;
  };

  using RowId = std::uint32_t;

  void add_row(std::unordered_map<std::uint64_t, RowId>& rows, std::uint64_t key, Row row);
  std::uint64_t place_key(Place place, Time time) const;
  std::uint64_t edge_key(Place from, Place to, Time arrival) const;
  void count_uses(std::span<const Path> paths, const Encounters& encounters);
  void count_moves(const Path& path, Time end);
  void count_move(Place from, Place to, Time arrival);
  void use_edge(Place from, Place to, Time arrival);
  void give(Row& row);
  void charge(const Row& row, Amount more);
  void charge_finish(AgentIndex agent, Time by, Amount more);

  const World& world_;
  Penalties penalties_;
  std::vector<std::vector<Amount>> on_finish_;  // by agent
  std::vector<Row> rows_;
  std::unordered_map<std::uint64_t, RowId> place_rows_;
  std::unordered_map<std::uint64_t, RowId> edge_rows_;
  std::vector<std::uint8_t> has_edge_rows_;                            // by place
  std::unordered_map<std::uint64_t, std::vector<RowId>> finish_rows_;  // by pair of agents
  Price sum_ = 0;
};

}  // namespace grove::detail
