// SPDX-License-Identifier: MIT
// Lagrangian multipliers of relaxed rows, the resulting penalties on paths, and updates for copies
// in other processes.
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

// A message with the difference between a Multipliers object and an earlier state of it. A value
// type.
struct MultiplierUpdate {
  std::vector<RelaxedRow> rows;
  // For each row whose multiplier has changed, in order: the number of unchanged rows between the
  // previous changed row and this one, and the difference. multipliers.cpp defines the encoding.
  std::string multipliers;
};

// Relaxed rows with integer multipliers >= 0, in units of 1 / Penalties::kUnit step. While one
// thread changes the object, no other thread may use it; otherwise any thread may read it.
class Multipliers {
 public:
  using Amount = Penalties::Amount;
  using RowId = std::uint32_t;

  // `world` must outlive this object.
  Multipliers(const World& world, int agents);

  const Penalties& penalties() const { return penalties_; }
  // By time: the penalty of `agent` for finishing at that time; 0 for times from the end of the
  // span on.
  std::span<const Amount> on_finish(AgentIndex agent) const { return on_finish_[agent]; }
  // The penalised cost of a path of `agent`: its cost plus the multipliers of the rows that it
  // uses.
  ScaledCost price(AgentIndex agent, const Path& path) const;
  ScaledCost sum() const { return sum_; }
  // Digest of the rows and their multipliers. Equal multipliers have equal digests. Different
  // multipliers have equal digests with a probability of about 2^-64.
  std::uint64_t digest() const { return digest_; }

  std::size_t count() const { return rows_.size(); }
  const RelaxedRow& row(RowId id) const { return rows_[id]; }
  Amount multiplier(RowId id) const { return multipliers_[id]; }
  // Adds a row with multiplier 0. Rows are numbered in the order of insertion.
  void add(const RelaxedRow& row);
  // Sets the multiplier of a row, and updates penalties, sum and digest.
  void set_multiplier(RowId id, Amount amount);

  // The update for a copy that has the first known.size() rows, with the multipliers `known`. Sets
  // `known` to the current multipliers.
  MultiplierUpdate update_for(std::vector<Amount>& known) const;
  // Applies an update. Throws std::invalid_argument if the update is malformed or cannot be for
  // this state of the copy; it may then be applied in part.
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
