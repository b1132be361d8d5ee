// SPDX-License-Identifier: MIT
// Clauses whose models contain a path of an agent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "cores/path_graph.h"
#include "cores/place_conflicts.h"
#include "cores/sat_solver.h"
#include "cores/traversal_clauses.h"
#include "planning/constraint.h"

namespace grove::detail {

// The clauses of one agent's paths, with literals for limits on its cost and for constraints on it.
// *Contract*: each path of the agent defines an assignment that satisfies all these clauses. In it,
// within(e) is true exactly if the path costs at most least_cost() + e, and satisfies(c) exactly
// if the path satisfies c; counts() in the same way. The proof is at the head of path_clauses.cpp.
// One thread at a time.
class PathClauses {
 public:
  // All arguments must outlive this object.
  PathClauses(SatSolver& solver, AgentIndex agent, const PathGraph& graph,
              const Corridors& corridors, PlaceConflicts& conflicts);

  // Adds the clauses for one more unit of excess, from 0 on, to which the graph has grown.
  void grow();
  // Adds those of at most `max_nodes` nodes of the graph, and returns whether they are complete.
  // Until then, the solver must not be called.
  bool grow(PathGraph::Node max_nodes);
  // Units of excess with complete clauses.
  Time levels() const { return levels_; }
  // Literal for "the agent costs at most least_cost() + `excess`"; `excess` may be >= levels().
  Literal within(Time excess);
  // Literal that is true if the model contains any node. Every model can be changed to one in which
  // it is false, together with within(e) for all e, unless other clauses require within(e).
  Literal active() const { return active_; }
  // Literal for "the path satisfies `constraint`", which must not be on the sequence.
  Literal satisfies(const Constraint& constraint);

  // Literal for "the path counts this stop" or, if `counts` is false, "it does not". Neither is the
  // negation of the other one.
  Literal counts(int stop, bool counts);

  // A walk of the model that the solver has found; nullopt if the model lets the agent cost more
  // than the clauses cover.
  std::optional<std::vector<PathGraph::Node>> walk() const;
  // Decisions of the solver try this walk first, instead of the walk of the last call.
  void prefer(const std::vector<PathGraph::Node>& walk);

 private:
  struct ConstraintLiteral {
    Constraint constraint;
    Literal literal;
  };
  struct CountLiteral {
    int stop;
    bool counts;
    Literal literal;
  };
  using Constraints = std::vector<std::size_t>;  // indices in constraints_

  Literal literal_of(PathGraph::Node node);
  void start_level();
  Literal new_node_variable(PathGraph::Node node);
  Literal new_presence_variable(const Presence& presence);
  void add_to_presence(Literal node, const Presence& presence);
  void set_presence(const Presence& presence, Literal literal);
  void add_walk_clauses(PathGraph::Node node);
  void restrict_end(const CountLiteral& by, PathGraph::Node node);
  void restrict_presence(const ConstraintLiteral& by, const Presence& presence);
  void restrict_move(const ConstraintLiteral& by, const Presence& presence);
  TraversalClauses& traversals(const Constraint& constraint);

  SatSolver& solver_;
  const AgentIndex agent_;
  const PathGraph& graph_;
  const Corridors& corridors_;
  PlaceConflicts& conflicts_;
  const bool is_node_presence_;  // no two nodes have the same presence
  const Literal active_;
  Time levels_ = 0;
  PathGraph::Node next_ = 0;                      // first node without clauses for the next level
  std::vector<Literal> nodes_;                    // by node; 0: no literal yet
  std::vector<std::uint8_t> has_all_successors_;  // by node: in a clause for all levels
  std::vector<Literal> within_;                   // by excess
  PresenceLiterals presences_;
  std::unordered_set<Literal> of_one_node_;  // literals of nodes that are those of presences
  std::vector<Literal> preferred_;
  std::vector<ConstraintLiteral> constraints_;
  std::unordered_map<Place, Constraints> constraints_on_;  // by place that they mention
  Constraints rest_bys_;
  std::vector<CountLiteral> counts_;
  std::vector<TraversalClauses> traversals_;
};

}  // namespace grove::detail
