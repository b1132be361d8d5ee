// SPDX-License-Identifier: MIT
// What is known about agents that must together cost more than each alone.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/detail/search/hash_index.h"
#include "grove/detail/search/sharded.h"
#include "grove/detail/search/situations.h"

namespace grove::detail {

// By how much pairs and groups of agents in given situations cost more together than each alone.
// Groups are named by their agents in ascending order and by the situations of these. All methods
// may be called from any thread.
class Excesses {
 public:
  using Id = Situations::Id;

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

    // `situations_now`, by AgentIndex: are these agents in these situations?
    bool is_in(const std::vector<Id>& situations_now) const {
      return std::ranges::equal(situations, agents, {}, {},
                                [&](AgentIndex agent) { return situations_now[agent]; });
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

  Known of_pair(Id first, Id second) const;
  // The agent is the second one. True, here and below: it was news.
  bool learn_pair(Id first, Id second, AgentIndex agent, Known known);
  // Of an agent in a situation, those of greater index that it costs more with. Appended.
  void partners(Id first, std::vector<Partner>& partners) const;

  Known of_group(const std::vector<Id>& situations) const;
  bool learn_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& situations,
                   Known known);
  // Calls use(group) for each group listed under a situation: it is the newest of the group's, the
  // one that is in the fewest groups. `use` must not call this object, and copies what it keeps.
  template <class Use>
  void groups_listed_under(Id situation, Use use) const {
    parts_.with(parts_.part_of(situation), [&](const Part& part) {
      for (const Group& group : part.groups.of(situation)) use(group);
    });
  }

  // The situation that a group is listed under.
  static Id newest(const std::vector<Id>& situations);

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
  struct Part {
    std::vector<Pair> pairs;
    HashIndex index;          // of pairs
    Lists<Partner> partners;  // by the first
    Lists<Group> groups;      // by the newest
    std::size_t listed_partners = 0;
    std::size_t listed_groups = 0;

    void list(const Partner& partner, Id first);
    HashIndex::Number find(Id first, Id second) const;
    std::size_t bytes() const;
  };

  // Calls what(part), which returns whether that was news, and keeps count of the bytes.
  template <class What>
  bool learn(Id under, What what);

  Sharded<Part> parts_;  // by the situation that a pair or group is listed under
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace grove::detail
