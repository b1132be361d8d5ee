// SPDX-License-Identifier: MIT
// What is known about single agents under sets of constraints.
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

// As below, as a value.
struct AgentSubproblem {
  const AgentSequencing* order = nullptr;
  AgentIndex agent = -1;
  PackedConstraints constraints;  // in canonical order
};

// A *situation* is an agent with its order of visits and a set of constraints. Most nodes of a
// constraint tree ask about situations that others asked about before: they are numbered as they
// come up, and what is found out about each is kept. Keys are compared in full, so a hash can cost
// time, never an answer. Costs are functions of the situation alone, so this memory changes no
// result. All methods may be called from any thread.
class SubproblemTable {
 public:
  using Id = std::int32_t;

  struct Known {
    Time at_least = 0;   // no path costs less; kNever: there is no path
    bool exact = false;  // a path of that cost exists, or `at_least` is kNever
    bool hard = false;   // finding out was once given up
    friend bool operator==(const Known&, const Known&) = default;
  };

  // The number of a situation. `constraints` must be in canonical order, see canonical(). `order`
  // must outlive this object.
  Id id(AgentIndex agent, const AgentSequencing& order, std::span<const Constraint> constraints);
  Id id(const AgentSubproblem& situation);

  // What has this number.
  AgentSubproblem situation(Id id) const;

  // The bytes of its constraints, packed: the more there are, the fewer nodes have this situation.
  std::size_t constraint_bytes(Id id) const;

  Known known(Id id) const;
  // Adds what was found out; the stronger statement stays. True: it was news.
  bool merge(Id id, Known known);

  // Memory held, in bytes (about).
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  struct Entry {
    std::uint32_t first;  // byte of its key
    Known known;
  };
  struct Part {
    std::vector<Entry> entries;
    std::string keys;  // one after the other
    HashIndex index;   // of entries

    Id find_or_add(std::uint32_t hash, std::string_view key);
    std::string_view key(Id entry) const;
    std::size_t bytes() const;
  };

  Id id_of_key(const AgentSequencing& order, std::string_view key);

  Sharded<Part> parts_;  // an Id is the place in a part and the part's number
  std::atomic<std::size_t> bytes_{0};
};

// Puts a list of constraints into the order that Situations wants, repeated ones once.
void canonical(std::vector<Constraint>& constraints);
// Adds one to a list in that order, if it is not there.
void add_to_canonical(std::vector<Constraint>& constraints, const Constraint& more);

}  // namespace grove::detail
