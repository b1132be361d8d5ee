// SPDX-License-Identifier: MIT
// Pattern databases of groups of agents, and the best grouping: the estimate of epea_star.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "joint/pattern_database.h"
#include "model/limits.h"
#include "model/omega.h"

namespace grove::detail {

// Databases of pairs and triples of agents. Small ones are made before the search; larger ones,
// called late, when the search has taken as much work as they do. One thread at a time.
class DatabaseGroups {
 public:
  using Node = AgentGraph::Node;

  // Without databases. Both must outlive this.
  DatabaseGroups(const Instance& instance, std::span<const AgentGraph> agents)
      : instance_(instance), agents_(agents) {}

  // Plans databases for all pairs, then for all triples, if they are small enough. There is no
  // database of all agents: the search itself is that database.
  void plan();
  // Whether a database must be made before the search.
  bool are_due() const { return !to_come_.empty(); }
  // Makes the next one of these. Returns false if a limit was reached.
  bool make_next(const Limits& limits);
  // The same for the late ones, which are due if all databases together take at most the work
  // `of_search`.
  bool is_late_due(std::int64_t of_search) const;
  bool make_late(const Limits& limits);

  // Lower bound on the excess of the joint cost over the sum of individual costs at `nodes` (one
  // per agent): that of the best grouping. kInfiniteCost: from there the agents cannot all come to
  // rest.
  Cost excess(const Node* nodes);

  // Number of the databases made, their bytes, and their work, in the unit of search/work.h.
  std::size_t count() const { return databases_.size(); }
  std::size_t bytes() const { return bytes_; }
  std::int64_t work() const { return work_; }

 private:
  static constexpr std::size_t kMaxGrouped =
      8;  // agents; with more, finding the best grouping takes too long
  // Databases of disjoint groups, by number; unused entries hold count().
  using Grouping = std::array<std::uint8_t, kMaxGrouped / 2>;
  using Members = std::vector<std::size_t>;  // positions in agents_

  void plan(Members members);
  std::int64_t work_of(const Members& members) const {
    return PatternDatabase::work(agents_, members);
  }
  bool make_first(std::deque<Members>& of, const Limits& limits);
  void group();
  void add_groupings(std::size_t first, unsigned taken, Grouping so_far, std::size_t count);

  const Instance& instance_;
  const std::span<const AgentGraph> agents_;
  std::deque<Members> to_come_;  // members of databases to make before the search
  std::deque<Members> late_;     // the same for larger ones
  std::int64_t planned_work_ = 0;
  std::vector<PatternDatabase> databases_;
  std::vector<Grouping> groupings_;  // all maximal groupings
  std::vector<int> excess_;          // by database, of the nodes in progress; one more entry: 0
  std::int64_t work_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace grove::detail
