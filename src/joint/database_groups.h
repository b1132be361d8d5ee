// SPDX-License-Identifier: MIT
// Pattern databases for groups of agents, and the best grouping: the source of the estimate in
// epea_star.cpp.
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

// Databases for pairs and triples of agents. Small databases are made before the search; larger
// ones, called *late*, are made once the search has taken as much effort as all databases so far
// and the next one take together. One thread at a time.
class DatabaseGroups {
 public:
  using Node = AgentGraph::Node;

  // Starts without databases. `instance` and the elements of `agents` must outlive this object.
  DatabaseGroups(const Instance& instance, std::span<const AgentGraph> agents)
      : instance_(instance), agents_(agents) {}

  // Plans databases for the pairs, then for the triples, that are small enough; none if there are
  // more than kMaxGrouped agents. No database for all agents is planned, because the search itself
  // would be that database.
  void plan();
  // Whether a planned database must still be made before the search.
  bool is_early_due() const { return !due_.empty(); }
  // Makes the next database that must be made before the search. Requires is_early_due(). Returns
  // false if a limit was reached.
  bool make_next(const Limits& limits);
  // is_late_due(): whether there is a late database to make and it, together with all databases
  // made so far, takes at most the effort `of_search` (unit of model/effort.h). make_late(): makes
  // it; returns false if a limit was reached.
  bool is_late_due(std::int64_t of_search) const;
  bool make_late(const Limits& limits);

  // Lower bound on the excess of the joint cost over the sum of individual costs at `nodes` (one
  // per agent): the sum over the best grouping. kInfiniteCost: the agents cannot all come to rest
  // from there.
  Cost excess(const Node* nodes);

  // Number of databases made, their bytes, and the effort of making them in the unit of
  // model/effort.h.
  std::size_t count() const { return databases_.size(); }
  std::size_t bytes() const { return bytes_; }
  std::int64_t work() const { return work_; }

 private:
  // Maximum number of agents; with more, finding the best grouping takes too long.
  static constexpr std::size_t kMaxGrouped = 8;
  // Databases with disjoint members, by their number; unused entries hold count().
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
  std::deque<Members> due_;   // members of the databases to make before the search
  std::deque<Members> late_;  // members of the late databases
  std::int64_t planned_work_ = 0;
  std::vector<PatternDatabase> databases_;
  std::vector<Grouping> groupings_;  // all maximal groupings
  std::vector<int> excess_;          // by database, at the current nodes; the last entry is 0
  std::int64_t work_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace grove::detail
