// SPDX-License-Identifier: MIT
// Table of WDG edge and hyperedge weights: how much more agents cost together than individually.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "search/hash_index.h"
#include "search/sharded.h"
#include "search/subproblem_table.h"

namespace grove::detail {

// Weights (*excesses*) of pairs and groups of agents, keyed by the agents' subproblems. An excess
// is a lower bound on the joint cost of the agents minus the sum of their individual costs. A
// subproblem is an agent with its sequence class and its set of constraints; subproblem_table.h
// numbers the subproblems. The key of a group consists of its agents in ascending order and their
// subproblems. Thread-safe.
//
// A group is *listed* under its rarest subproblem, because few nodes look up that subproblem. The
// list entry also stores the second rarest subproblem. Most groups that do not apply to a node
// already differ from it in that subproblem.
class DependencyTable {
 public:
  using Id = SubproblemTable::Id;

  struct ExcessBound {
    Cost excess = 0;              // proven lower bound
    bool exact = false;           // conflict-free paths with this excess exist
    std::int32_t expansions = 0;  // node expansions spent on it
    friend bool operator==(const ExcessBound&, const ExcessBound&) = default;
  };
  // Three or more agents, in ascending order, with their subproblems.
  struct Group {
    std::vector<AgentIndex> agents;
    std::vector<Id> subproblems;
    ExcessBound known;

    // Returns whether the group applies to a node with the subproblems `now`, by AgentIndex.
    bool is_at(const std::vector<Id>& now) const {
      return std::ranges::equal(subproblems, agents, {}, {},
                                [&](AgentIndex agent) { return now[agent]; });
    }
  };
  // The second agent of a pair with positive excess.
  struct Partner {
    AgentIndex agent;
    Id subproblem;
    Cost excess;
  };

  // Conjunction of two entries for the same key. It is commutative and associative, so the order of
  // merges does not matter.
  static ExcessBound join(ExcessBound a, ExcessBound b) {
    return {std::max(a.excess, b.excess), a.exact || b.exact, std::max(a.expansions, b.expansions)};
  }

  // `subproblems` numbers the subproblems and must outlive this object.
  explicit DependencyTable(const SubproblemTable& subproblems) : subproblems_(subproblems) {}

  // The entry of a pair, or ExcessBound() if there is none. `first` is the subproblem of the agent
  // with the smaller index.
  ExcessBound of_pair(Id first, Id second) const;
  // `agent` is the agent of `second`. merge_pair() and merge_group() return whether the table
  // changed.
  bool merge_pair(Id first, Id second, AgentIndex agent, ExcessBound known);
  // Appends the agents of greater index, with their subproblems, that have a positive excess with
  // the subproblem `first`. An agent can occur several times, with different subproblems.
  void partners(Id first, std::vector<Partner>& partners) const;

  // The entry of a group, or ExcessBound() if there is none.
  ExcessBound of_group(const std::vector<Id>& subproblems) const;
  bool merge_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& subproblems,
                   ExcessBound known);
  // Calls use(group) once for each group that applies to a node with the subproblems `now`, by
  // AgentIndex. `use` runs under a lock: it must not call this object, and it must copy whatever it
  // keeps. Returns the number of groups that were compared in full.
  template <class Use>
  std::int64_t groups_at(const std::vector<Id>& now, Use use) const {
    std::int64_t looked_at = 0;
    for (const Id subproblem : now)
      parts_.with(parts_.part_of(subproblem), [&](const Part& part) {
        for (const ListedGroup& listed : part.groups.of(subproblem)) {
          if (now[listed.agent] != listed.subproblem) continue;
          ++looked_at;
          const Group& group = part.all_groups[listed.number];
          if (group.is_at(now)) use(group);
        }
      });
    return looked_at;
  }

  // Approximate memory use in bytes.
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  struct Pair {
    Id first;
    Id second;
    ExcessBound known;
  };
  // One list of items per subproblem, looked up by array index instead of a hash table, because the
  // subproblems of a part have consecutive positions (Id / kParts).
  template <class Item>
  class Lists {
   public:
    std::span<const Item> of(Id subproblem) const {
      const std::size_t place = place_of(subproblem);
      if (place >= list_.size() || list_[place] < 0) return {};
      return lists_[static_cast<std::size_t>(list_[place])];
    }
    std::vector<Item>& at(Id subproblem);
    std::size_t bytes() const {
      return list_.capacity() * sizeof(std::int32_t) + lists_.capacity() * sizeof(lists_.front());
    }

   private:
    static std::size_t place_of(Id subproblem) {
      return static_cast<std::size_t>(subproblem) / Sharded<int>::kParts;
    }

    std::vector<std::int32_t> list_;  // by position: index in lists_; -1 if there is no list
    std::vector<std::vector<Item>> lists_;
  };
  struct ListedGroup {
    AgentIndex agent;  // the agent with the second rarest subproblem
    Id subproblem;
    std::int32_t number;  // index in all_groups
  };
  struct Part {
    std::vector<Pair> pairs;
    HashIndex index;          // of pairs
    Lists<Partner> partners;  // by first subproblem
    std::vector<Group> all_groups;
    Lists<ListedGroup> groups;  // by rarest subproblem
    std::size_t listed_partners = 0;

    void list(const Partner& partner, Id first);
    HashIndex::Number find(Id first, Id second) const;
    std::int32_t find_group(Id rarest, Id next, const std::vector<Id>& subproblems) const;
    std::size_t bytes() const;
  };

  // Calls what(part) for the part of `under` and updates bytes_. `what` returns whether it changed
  // the part; merge() returns the same.
  template <class What>
  bool merge(Id under, What what);

  // Positions in `subproblems` of the rarest and the second rarest subproblem of a group. A
  // subproblem counts as rarer if its constraints take more bytes. (Its age would be misleading: a
  // subproblem received from another process is new here but need not be rare.) Ties go to the
  // larger number, which usually belongs to the newer subproblem.
  std::array<std::size_t, 2> rarest_two(const std::vector<Id>& subproblems) const;

  const SubproblemTable& subproblems_;
  Sharded<Part> parts_;  // by the subproblem under which a pair or group is listed
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace grove::detail
