// SPDX-License-Identifier: MIT
// Table of low-level subproblems (agent, sequence class, constraint set) and their proven costs.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "search/hash_index.h"
#include "search/node.h"
#include "search/packed_constraints.h"
#include "search/sharded.h"

namespace grove::detail {

// A subproblem (see SubproblemTable), as a value.
struct AgentSubproblem {
  const AgentSequencing* order = nullptr;
  AgentIndex agent = -1;
  PackedConstraints constraints;  // in canonical order
};

// Numbers the low-level subproblems and caches a cost bound for each. A subproblem is an agent with
// its sequence class and a set of constraints. Most nodes of a constraint tree query subproblems
// that other nodes have queried before. Keys are compared in full, so a hash collision costs time
// but never changes a result. The cost of a subproblem depends only on its key, so the cache
// changes no result. Thread-safe.
class SubproblemTable {
 public:
  using Id = std::int32_t;

  struct CostBound {
    Time lower_bound = 0;      // no path costs less; kNever: there is no path
    bool exact = false;        // a path of that cost exists, or `lower_bound` is kNever
    bool was_aborted = false;  // a computation of the cost was once aborted as too expensive
    friend bool operator==(const CostBound&, const CostBound&) = default;
  };

  // The number of a subproblem, which is added if it is new. `order` is compared by address.
  // `constraints` must be in canonical order; see canonical(). `order` must outlive this object.
  Id id(AgentIndex agent, const AgentSequencing& order, std::span<const Constraint> constraints);
  Id id(const AgentSubproblem& subproblem);

  // The subproblem with this number.
  AgentSubproblem subproblem(Id id) const;

  // Size of the packed constraints of a subproblem, in bytes. The more constraints, the fewer nodes
  // share the subproblem.
  std::size_t constraint_bytes(Id id) const;

  CostBound known(Id id) const;
  // Merges `known` into the entry of `id`, which keeps the stronger bound. Returns whether the
  // entry changed.
  bool merge(Id id, CostBound known);

  // Memory in use, in bytes (approximate).
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  struct Entry {
    std::uint32_t first;  // offset of its key in `keys`
    CostBound known;
  };
  struct Part {
    std::vector<Entry> entries;
    std::string keys;  // concatenated
    HashIndex index;   // of `entries`

    Id find_or_add(std::uint32_t hash, std::string_view key);
    std::string_view key(Id entry) const;
    std::size_t bytes() const;
  };

  Id id_of_key(const AgentSequencing& order, std::string_view key);

  Sharded<Part> parts_;  // an Id combines the position in a part and the part's number
  std::atomic<std::size_t> bytes_{0};
};

// Sorts a list of constraints into canonical order and removes duplicates.
void canonical(std::vector<Constraint>& constraints);
// Inserts `more` into a list in canonical order, unless the list contains it.
void add_to_canonical(std::vector<Constraint>& constraints, const Constraint& more);

}  // namespace grove::detail
