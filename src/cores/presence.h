// SPDX-License-Identifier: MIT
// Literals for the presence of an agent on places.
#pragma once

#include <cstddef>
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
    const auto at = numbers_.find(presence.key());
    return at == numbers_.end() ? 0 : list_[at->second].second;
  }
  // Replaces the literal that the presence has, if any.
  void set(const Presence& presence, Literal literal) {
    const auto [at, is_new] = numbers_.try_emplace(presence.key(), list_.size());
    if (is_new)
      list_.emplace_back(presence, literal);
    else
      list_[at->second].second = literal;
  }
  // In order of their first literals.
  const std::vector<std::pair<Presence, Literal>>& all() const { return list_; }
  // Calls visit(literal) for each literal of an arrival on `place` at `time`, for good or not.
  template <class Visit>
  void for_each_at(Place place, Time time, Visit visit) const {
    for (const bool is_last : {false, true})
      if (const Literal literal = find({place, time, is_last})) visit(literal);
  }

 private:
  std::unordered_map<std::uint64_t, std::size_t> numbers_;  // in list_, by Presence::key()
  std::vector<std::pair<Presence, Literal>> list_;
};

}  // namespace grove::detail
