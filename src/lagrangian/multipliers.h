// SPDX-License-Identifier: MIT
// What each agent has to pay for, and to whom that can be told.
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

// What a tariff has that another, an earlier state of it, has not. A value.
struct MultiplierUpdate {
  std::vector<RelaxedRow> rows;
  // Of each row whose charge has changed: how many rows since the one before have not, and by how
  // much; in few bytes.
  std::string charges;
};

// Rows, and what is charged for the use of each: the multipliers as they are paid. For one thread
// at a time; any number may read meanwhile if nobody writes.
class Multipliers {
 public:
  using Amount = Penalties::Amount;
  using RowId = std::uint32_t;

  // `world` must outlive this.
  Multipliers(const World& world, int agents);

  const Penalties& penalties() const { return penalties_; }
  // What an agent pays for finishing at a time; 0 beyond the end.
  std::span<const Amount> on_finish(AgentIndex agent) const { return on_finish_[agent]; }
  // What a path costs with all of that.
  ScaledCost price(AgentIndex agent, const Path& path) const;
  ScaledCost sum() const { return sum_; }
  // Names the charges: those of two tariffs are the same if this is, but for a chance of 2^-64.
  std::uint64_t digest() const { return digest_; }

  std::size_t count() const { return rows_.size(); }
  const RelaxedRow& row(RowId id) const { return rows_[id]; }
  Amount charge(RowId id) const { return multipliers_[id]; }
  // Rows are numbered in the order in which they come; nothing is charged for a new one.
  void add(const RelaxedRow& row);
  // The penalties change with it.
  void set_multiplier(RowId id, Amount amount);

  // What must be told to whoever knows so many rows with these charges. Then `known` is what there
  // is here.
  MultiplierUpdate update_for(std::vector<Amount>& known) const;
  // Takes over what was told. Throws std::invalid_argument for what cannot be told to this one.
  void learn(const MultiplierUpdate& news);

 private:
  void put_on_path(const RelaxedRow& row, Amount more);
  void put_on_finish(AgentIndex agent, Time by, Amount more);
  bool is_possible(const RelaxedRow& row) const;

  const World& world_;
  Penalties penalties_;
  std::vector<std::vector<Amount>> on_finish_;  // by agent
  std::vector<RelaxedRow> rows_;
  std::vector<Amount> multipliers_;  // by row
  ScaledCost sum_ = 0;
  std::uint64_t digest_ = 0;
};

}  // namespace grove::detail
