// SPDX-License-Identifier: MIT
// Bounds from pairs of agents that cannot both have their best paths.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "grove/search/brancher.h"
#include "grove/search/covering.h"

namespace grove {

// The pairwise-dependency heuristic of CBS (WDG: Li et al., IJCAI 2019), with a memory that serves
// all nodes. The essay is at the head of dependencies.cpp. Of one thread.
class Dependencies {
 public:
  // All must outlive this.
  Dependencies(const Problem& problem, Techniques techniques, std::uint64_t seed,
               PathPlanner& planner, Situations& situations);

  // A proven lower bound on every plan that obeys the constraints of `node`, which `view` has
  // entered with all agents; or `cutoff`, if none of them is cheaper. None: a limit struck.
  std::optional<Cost> bound(const NodePtr& node, Brancher& view, Cost cutoff, const Limits& limits);

  // Expansions in pairs so far.
  std::int64_t expansions() const { return expansions_; }

  // Memory held, in bytes (about). clear() must be called when the situations are cleared.
  std::size_t bytes() const;
  void clear() { known_.clear(); }

 private:
  // What is known of two agents in two situations.
  struct Known {
    Cost excess = 0;              // they cost at least so much more together than each alone
    bool exact = false;           // and a conflict-free pair of paths costs that
    std::int32_t expansions = 0;  // spent on it
  };
  struct Open {
    Cost cost;
    NodePtr node;
  };

  std::uint64_t key(AgentIndex a, AgentIndex b) const;
  bool solve_conflicting(const NodePtr& node, Brancher& view, Cost slack, const Limits& limits);
  bool solve(const NodePtr& node, AgentIndex a, AgentIndex b, Cost slack, const Limits& limits,
             Known& known);
  void collect(std::vector<GroupExcess>& statements) const;

  const int agents_;
  Brancher pair_view_;
  std::unordered_map<std::uint64_t, Known> known_;
  std::vector<Situations::Id> situation_;  // by AgentIndex, at the node
  std::vector<Open> open_;                 // a heap: least cost first
  std::vector<NodePtr> children_;
  std::int64_t expansions_ = 0;
};

}  // namespace grove
