// SPDX-License-Identifier: MIT
// Lagrangian multipliers of relaxed rows, as penalties on paths, with updates for copies in other
// processes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lagrangian/penalized_search.h"
#include "lagrangian/penalties.h"
#include "lagrangian/relaxed_row.h"

namespace grove::detail {

// The difference between Multipliers and an earlier state of them. A value.
struct MultiplierUpdate {
  std::vector<RelaxedRow> rows;
  // For each row whose multiplier has changed: the number of unchanged rows since the previous
  // changed one, and the difference. Encoding: multipliers.cpp.
  std::string multipliers;
};

// Relaxed rows with integer multipliers, in units of 1 / Penalties::kUnit step. One thread at a
// time while it is changed; otherwise any thread may read it.
class Multipliers {
 public:
  using Amount = Penalties::Amount;
  using RowId = std::uint32_t;

  // `world` must outlive this.
  Multipliers(const World& world, int agents);

  const Penalties& penalties() const { return penalties_; }
  // By finish time: the penalty of an agent for finishing then; 0 beyond the end.
  std::span<const Amount> on_finish(AgentIndex agent) const { return on_finish_[agent]; }
  // Penalised cost of a path.
  ScaledCost price(AgentIndex agent, const Path& path) const;
  ScaledCost sum() const { return sum_; }
  // Digest of the multipliers: equal for equal multipliers; different ones have equal digests with
  // probability 2^-64.
  std::uint64_t digest() const { return digest_; }

  std::size_t count() const { return rows_.size(); }
  const RelaxedRow& row(RowId id) const { return rows_[id]; }
  Amount multiplier(RowId id) const { return multipliers_[id]; }
  // Adds a row with multiplier 0. Rows are numbered in the order of insertion.
  void add(const RelaxedRow& row);
  // Sets a multiplier, and updates the penalties.
  void set_multiplier(RowId id, Amount amount);

  // The update for a copy that has known.size() rows with the multipliers `known`. Sets `known` to
  // the current multipliers.
  MultiplierUpdate update_for(std::vector<Amount>& known) const;
  // Applies an update. Throws std::invalid_argument if the update does not fit these multipliers.
  void apply(const MultiplierUpdate& update);

 private:
  void put_on_path(const RelaxedRow& row, Amount more);
  void put_on_finish(AgentIndex agent, Time by, Amount more);
  bool is_valid_row(const RelaxedRow& row) const;

  const World& world_;
  Penalties penalties_;
  std::vector<std::vector<Amount>> on_finish_;  // by agent
  std::vector<RelaxedRow> rows_;
  std::vector<Amount> multipliers_;  // by row
  ScaledCost sum_ = 0;
  std::uint64_t digest_ = 0;
};

}  // namespace grove::detail
