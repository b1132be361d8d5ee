// SPDX-License-Identifier: MIT
// Literals for the presence of an agent on places.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cores/sat_solver.h"
#include "model/world.h"

namespace grove::detail {

// An agent is on `place` at `time`. It either leaves the place later, or, if `is_last`, arrives at
// `time` for good.
struct Presence {
  Place place;
  Time time;
  bool is_last;

  // Different presences have different keys.
  std::uint64_t key() const {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(place)) << 32 |
           static_cast<std::uint64_t>(time) << 1 | (is_last ? 1 : 0);
  }
};

// The literals of one agent's presences.
class PresenceLiterals {
 public:
  // Returns 0 if the presence has no literal.
  Literal find(const Presence& presence) const {
    const auto at = literals_.find(presence.key());
    return at == literals_.end() ? 0 : at->second;
  }
  void insert(const Presence& presence, Literal literal) {
    literals_.emplace(presence.key(), literal);
    list_.emplace_back(presence, literal);
  }
  // In order of insertion.
  const std::vector<std::pair<Presence, Literal>>& all() const { return list_; }
  // Calls visit(literal) for each literal of an arrival on `place` at `time`, for good or not.
  template <class Visit>
  void for_each_at(Place place, Time time, Visit visit) const {
    for (const bool is_last : {false, true})
      if (const Literal literal = find({place, time, is_last})) visit(literal);
  }

 private:
  std::unordered_map<std::uint64_t, Literal> literals_;
  std::vector<std::pair<Presence, Literal>> list_;
};

}  // namespace grove::detail
