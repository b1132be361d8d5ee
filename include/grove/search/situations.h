// SPDX-License-Identifier: MIT
// What is known about single agents under sets of constraints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/search/node.h"

namespace grove {

// A *situation* is an agent with its order of visits and a set of constraints. Most nodes of a
// constraint tree ask about situations that others asked about before: they are numbered as they
// come up, and what is found out about each is kept. Keys are compared in full, so a hash can cost
// time, never an answer. Costs are functions of the situation alone, so this memory changes no
// result. One per thread.
class Situations {
 public:
  using Id = std::int32_t;

  struct Known {
    Time at_least = 0;   // no path costs less; kNever: there is no path
    bool exact = false;  // a path of that cost exists, or `at_least` is kNever
  };

  // The number of a situation. `constraints` must be in canonical order, see canonical(). `order`
  // must outlive this object or the next clear().
  Id id(AgentIndex agent, const AgentOrder& order, std::span<const Constraint> constraints);

  Known& known(Id id) { return entries_[id].known; }

  // Memory held, in bytes (about). clear() forgets everything and makes all numbers invalid.
  std::size_t bytes() const;
  void clear();

 private:
  struct Entry {
    std::uint64_t hash;
    const AgentOrder* order;
    AgentIndex agent;
    std::uint32_t first;  // of its constraints
    std::uint32_t count;
    Known known;
  };

  bool same(const Entry& entry, AgentIndex agent, const AgentOrder& order,
            std::span<const Constraint> constraints) const;
  void grow();

  std::vector<Entry> entries_;
  std::vector<Constraint> constraints_;
  std::vector<Id> table_;  // open addressing; a power of two
};

// Puts a list of constraints into the order that Situations wants, repeated ones once.
void canonical(std::vector<Constraint>& constraints);

}  // namespace grove
