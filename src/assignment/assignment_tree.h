// SPDX-License-Identifier: MIT
// Branch and bound over the choices of all agents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "assignment/assignment.h"
#include "assignment/route_bound.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"

namespace grove::detail {

// A tree whose nodes decide choices: agent a visits task t, or does not; agent a ends on goal g, or
// does not. The bound of a node is its Lagrangian bound on routes (route_bound.h), so it does not
// consider conflicts. A leaf is an assignment; its caller searches it for a plan or a bound.
// Best-first search. Repeatable, unless a limit is reached. One thread at a time.
class AssignmentTree {
 public:
  // A tree with the root node `bound`, of which it makes a copy. `instance` must outlive it.
  // max_bytes: for open nodes, about.
  AssignmentTree(const Instance& instance, const RouteBound& bound, std::size_t max_bytes);
  ~AssignmentTree();

  enum class Outcome : std::uint8_t {
    kOpen,    // the effort is spent, or a limit is reached
    kNode,    // see node()
    kClosed,  // proven: no plan costs less than the cutoff
    // The bound cannot rise: the nodes need too much memory, the least bound is that of a leaf that
    // was returned before, or the tree cannot be used (assignment_tree.cpp, or no Lagrangian
    // bound).
    kStuck,
  };
  // Continues for about `effort` scanned legs (NgWalks::effort()), for plans that cost less than
  // `cutoff`, which must not exceed that of the last call. After kNode, resolve() must come first.
  // offer_nodes: also returns each inner node once, before it is branched on.
  Outcome run(Cost cutoff, std::int64_t effort, bool offer_nodes, const Limits& limits);

  // After kNode: the open node with the least bound, for a search by other means.
  RouteBound& node();
  // Its assignment if it is a leaf.
  std::optional<Assignment> leaf() const;
  // States that each plan that costs less than the cutoff and makes the choices left in node()
  // costs at least `bound`.
  void resolve(Cost bound);

  // Proven: every plan that costs less than the cutoff of the last run() costs at least this.
  Cost lower_bound() const;
  std::int64_t nodes() const { return nodes_; }  // made so far

 private:
  struct Node;
  struct Branch;
  struct ByBound;

  bool expand(Node& node, bool offer_nodes, const Limits& limits);
  bool improve_root(Node& node, const Limits& limits) const;
  bool require_begun_tasks(RouteBound& bound) const;
  std::vector<Branch> branches(const RouteBound& bound) const;
  std::vector<Node> best_children(const Node& node, const std::vector<Branch>& candidates,
                                  const Limits& limits) const;
  void push(Node node);
  Node pop();

  const Instance& instance_;
  const std::size_t max_bytes_;
  std::size_t bytes_ = 0;          // of open_
  std::vector<Node> open_;         // heap
  std::unique_ptr<Node> offered_;  // between kNode and resolve()
  Cost cutoff_ = kInfiniteCost;
  std::int64_t nodes_ = 0;
};

}  // namespace grove::detail
