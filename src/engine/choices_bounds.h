// SPDX-License-Identifier: MIT
// Lower bounds for instances with choices, and the plans that their proofs find.
#pragma once

#include <memory>

#include "assignment/assignment_tree.h"
#include "assignment/route_bound.h"
#include "engine/all_assignments.h"
#include "engine/choices_result.h"
#include "engine/solve.h"
#include "model/limits.h"

namespace grove::detail {

// May an agent visit a task or leave it out?
bool has_optional_tasks(const Instance& instance);
// Improves the bound on routes for about 1 s.
void improve_routes(RouteBound& routes, const SolveOptions& options, const Limits& limits);

// Two searches alternate: a core-guided search over all assignments (engine/all_assignments.h), and
// branch and bound over choices (assignment/assignment_tree.h), which comes first while its bound
// rises. When the bound of the former has stalled, it also searches nodes of the tree. One thread
// at a time.
class ChoicesBounds {
 public:
  // All arguments must outlive this object.
  ChoicesBounds(const Instance& instance, const SolveOptions& options, const Limits& limits,
                MergedObserver& merged, RouteBound& route_bound, ChoicesResult& result);

  // False if neither search can continue. It can become true again, for example with a first plan.
  bool can_improve() const { return can_search_all() || can_search_tree(); }
  bool can_search_all() const { return cutoff_margin_ > 0; }
  // Searches for a while, usually less than a second. Precondition: can_improve().
  void improve();

 private:
  bool can_search_tree() const;
  bool comes_first() const;
  bool is_stalled() const;
  bool is_turn_of_tree() const;
  void search_tree();
  void search_node();
  void search_all();
  void use_result_of_all();
  void end_all();

  const Instance& instance_;
  const SolveOptions& options_;
  const Limits& limits_;
  MergedObserver& merged_;
  RouteBound& route_bound_;
  ChoicesResult& result_;
  // Can the bounds for single assignments be used? Without a destination an agent may rest on a
  // task that its assignment does not contain.
  const bool proves_leaves_;

  std::unique_ptr<AllAssignmentsSearch> all_;
  bool has_announced_all_ = false;
  Cost cutoff_ = kInfiniteCost;  // of all_
  // The cutoff of all_ is at most the bound plus this. 0: all assignments cannot be searched.
  Cost cutoff_margin_ = kInfiniteCost;
  std::unique_ptr<AssignmentTree> tree_;
  bool is_tree_over_;
  int idle_turns_ = 0;  // of the tree since its bound rose
  // Seconds; in deterministic runs, calls.
  double spent_on_all_ = 0;
  double spent_on_tree_ = 0;
  double since_rise_ = 0;  // of the bound of all_; part of spent_on_all_
};

}  // namespace grove::detail
