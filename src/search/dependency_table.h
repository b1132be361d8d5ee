// SPDX-License-Identifier: MIT
// What is known about agents that must together cost more than each alone.
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

// By how much pairs and groups of agents in given situations cost more together than each alone.
// Groups are named by their agents in ascending order and by the situations of these. All methods
// may be called from any thread.
//
// A group is *listed* under its rarest situation: few nodes ask for what is listed there. With it
// stands the next rarest, for most groups that are not at a node differ from it in that already.
class DependencyTable {
 public:
  using Id = SubproblemTable::Id;

  struct Known {
    Cost excess = 0;              // at least so much
    bool exact = false;           // and conflict-free paths cost that
    std::int32_t expansions = 0;  // spent on it
    friend bool operator==(const Known&, const Known&) = default;
  };
  // Several agents, in ascending order.
  struct Group {
    std::vector<AgentIndex> agents;
    std::vector<Id> situations;
    Known known;

    // `now`, by AgentIndex: are these agents in these situations?
    bool is_at(const std::vector<Id>& now) const {
      return std::ranges::equal(situations, agents, {}, {},
                                [&](AgentIndex agent) { return now[agent]; });
    }
  };
  // The other agent of a pair that costs more.
  struct Partner {
    AgentIndex agent;
    Id situation;
    Cost excess;
  };

  // What two say together. So it does not matter who says it first.
  static Known join(Known a, Known b) {
    return {std::max(a.excess, b.excess), a.exact || b.exact, std::max(a.expansions, b.expansions)};
  }

  // Of situations with these numbers, which must outlive this.
  explicit DependencyTable(const SubproblemTable& situations) : situations_(situations) {}

  Known of_pair(Id first, Id second) const;
  // The agent is the second one. True, here and below: it was news.
  bool merge_pair(Id first, Id second, AgentIndex agent, Known known);
  // Of an agent in a situation, those of greater index that it costs more with. Appended.
  void partners(Id first, std::vector<Partner>& partners) const;

  Known of_group(const std::vector<Id>& situations) const;
  bool merge_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& situations,
                   Known known);
  // Calls use(group) once for each group that is at a node with the situations `now`, by
  // AgentIndex. `use` must not call this object, and copies what it keeps. Returns how many groups
  // were looked at in full.
  template <class Use>
  std::int64_t groups_at(const std::vector<Id>& now, Use use) const {
    std::int64_t looked_at = 0;
    for (const Id situation : now)
      parts_.with(parts_.part_of(situation), [&](const Part& part) {
        for (const ListedGroup& listed : part.groups.of(situation)) {
          if (now[listed.agent] != listed.situation) continue;
          ++looked_at;
          const Group& group = part.all_groups[listed.number];
          if (group.is_at(now)) use(group);
        }
      });
    return looked_at;
  }

  // Memory held, in bytes (about).
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  struct Pair {
    Id first;
    Id second;
    Known known;
  };
  // What is listed under situations of a part, which are numbered one after the other.
  template <class Item>
  class Lists {
   public:
    std::span<const Item> of(Id situation) const {
      const std::size_t place = place_of(situation);
      if (place >= list_.size() || list_[place] < 0) return {};
      return lists_[static_cast<std::size_t>(list_[place])];
    }
    std::vector<Item>& at(Id situation);
    std::size_t bytes() const {
      return list_.capacity() * sizeof(std::int32_t) + lists_.capacity() * sizeof(lists_.front());
    }

   private:
    static std::size_t place_of(Id situation) {
      return static_cast<std::size_t>(situation) / Sharded<int>::kParts;
    }

    std::vector<std::int32_t> list_;  // by place: its number; -1: none
    std::vector<std::vector<Item>> lists_;
  };
  struct ListedGroup {
    AgentIndex agent;  // that is in the next rarest situation
    Id situation;
    std::int32_t number;
  };
  struct Part {
    std::vector<Pair> pairs;
    HashIndex index;          // of pairs
    Lists<Partner> partners;  // by the first
    std::vector<Group> all_groups;
    Lists<ListedGroup> groups;  // by the rarest
    std::size_t listed_partners = 0;

    void list(const Partner& partner, Id first);
    HashIndex::Number find(Id first, Id second) const;
    std::int32_t find_group(Id rarest, Id next, const std::vector<Id>& situations) const;
    std::size_t bytes() const;
  };

  // Calls what(part), which returns whether that was news, and keeps count of the bytes.
  template <class What>
  bool merge(Id under, What what);

  // The places of a group's rarest situation and of the next: those with the most constraints. (Not
  // those that came up last, which are not the rarest where others tell of them.) Of equal ones the
  // newest.
  std::array<std::size_t, 2> rarest_two(const std::vector<Id>& situations) const;

  const SubproblemTable& situations_;
  Sharded<Part> parts_;  // by the situation that a pair or group is listed under
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace grove::detail
