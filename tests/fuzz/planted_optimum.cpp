// SPDX-License-Identifier: MIT
// Losing the plan is an error even if other plans have the same cost. Only the global bounds prune
// by bound, and they never prune nodes whose bound is below the cost of the incumbent. All other
// operations (splitting a conflict, discarding a child, choosing the trees) must not lose any plan.
#include "tests/fuzz/planted_optimum.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tests/support/satisfies.h"

namespace grove::detail::fuzz {
namespace {

bool may_be_next(const SequenceClass& sequences, const Sequence& so_far, Stop stop) {
  const std::size_t fixed = sequences.prefix.size();
  if (so_far.size() < fixed) return sequences.prefix[so_far.size()] == stop;
  return so_far.size() > fixed || (sequences.forbidden_next >> stop & 1) == 0;
}

// Tests whether a path realizes any sequence of a class. Each stop counts at its first visit at or
// after the visit of the previous stop.
class RealizedSequences {
 public:
  RealizedSequences(const Instance& instance, AgentIndex agent, const SequenceClass& sequences,
                    const Path& path)
      : instance_(instance),
        tasks_(instance.agent(agent).stops),
        rests_on_task_(instance.rests_on_last_stop(agent)),
        sequences_(sequences),
        path_(path) {}

  bool any(std::size_t time = 0) {
    if (so_far_.size() == tasks_.size())
      return !rests_on_task_ || instance_.is_visited(tasks_[so_far_.back()], path_.back());
    for (Stop stop = 0; stop < static_cast<Stop>(tasks_.size()); ++stop) {
      if (std::ranges::count(so_far_, stop) > 0 || !may_be_next(sequences_, so_far_, stop))
        continue;
      const auto visit =
          std::find_if(path_.begin() + static_cast<std::ptrdiff_t>(time), path_.end(),
                       [&](State state) { return instance_.is_visited(tasks_[stop], state); });
      if (visit == path_.end()) continue;
      so_far_.push_back(stop);
      if (any(static_cast<std::size_t>(visit - path_.begin()))) return true;
      so_far_.pop_back();
    }
    return false;
  }

 private:
  const Instance& instance_;
  const std::vector<TaskIndex>& tasks_;
  const bool rests_on_task_;
  const SequenceClass& sequences_;
  const Path& path_;
  Sequence so_far_;
};

}  // namespace

bool satisfies_all(const Instance& instance, AgentIndex agent, const SequenceClass& sequences,
                   std::span<const Constraint> constraints, const Path& path) {
  const auto satisfies = [&](const Constraint& c) {
    return testing::satisfies(instance.world(), path, c);
  };
  return std::ranges::all_of(constraints, satisfies) &&
         RealizedSequences(instance, agent, sequences, path).any();
}

PlantedOptimum::PlantedOptimum(const Instance& instance, Plan optimum)
    : instance_(instance), optimum_(std::move(optimum)) {
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
    paths_.push_back(walked_path(instance, agent, optimum_.agents[agent]));
}

bool PlantedOptimum::held_by(const Node& node) const {
  std::vector<Constraint> constraints;
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
    constraints.clear();
    node.constraints(agent, constraints);
    if (!satisfies_all(instance_, agent, node.tree().orders[agent]->sequences, constraints,
                       paths_[agent]))
      return false;
  }
  return true;
}

void PlantedOptimum::follow(const NodePtr& node) {
  ++nodes_followed_;
  if (!found_) holding_.insert(node.get());
  if (node->bound() > optimum_.cost)
    complaints_.push_back(fmt::format("a node that holds a plan of cost {} claims the bound {}",
                                      optimum_.cost, node->bound()));
}

void PlantedOptimum::on_root(const NodePtr& root) {
  if (!held_by(*root)) return;
  evicted_bound_ = kInfiniteCost;
  follow(root);
}

void PlantedOptimum::on_expanded(const NodePtr& node, const Expansion& expansion, int) {
  if (holding_.erase(node.get()) == 0) return;
  // A worker can use an incumbent of this cost before the run reports it.
  bool kept = expansion.cutoff <= optimum_.cost ||
              (expansion.plan && expansion.plan->cost <= optimum_.cost);
  for (const NodePtr& child : expansion.children) {
    if (!held_by(*child)) continue;
    kept = true;
    follow(child);
  }
  if (!kept)
    complaints_.push_back(fmt::format(
        "expanding a node that holds a plan of cost {} lost it: {} children hold it no more",
        optimum_.cost, expansion.children.size()));
}

void PlantedOptimum::on_pruned(Cost bound) {
  if (bound < optimum_.cost)
    complaints_.push_back(
        fmt::format("nodes were pruned from {} on, but the optimum is {}", bound, optimum_.cost));
}

// A lower bound proven before the eviction stays valid.
void PlantedOptimum::on_evicted(const NodePtr& node) {
  if (holding_.erase(node.get()) > 0)
    evicted_bound_ = std::min(evicted_bound_, std::max(node->bound(), claimed_));
}

void PlantedOptimum::on_event(RunEvent, const Progress& progress) {
  claimed_ = progress.lower_bound;
  // A bound proven outside the trees does not depend on the evicted nodes.
  if (std::exchange(raised_outside_trees_, false))
    evicted_bound_ = std::max(evicted_bound_, progress.lower_bound);
  found_ = progress.incumbent && *progress.incumbent <= optimum_.cost;
  if (found_) holding_.clear();
  if (!found_ && progress.lower_bound > evicted_bound_)
    complaints_.push_back(
        fmt::format("lower bound {}, but a node of bound {} that held a plan was evicted",
                    progress.lower_bound, evicted_bound_));
  if (progress.lower_bound > optimum_.cost)
    complaints_.push_back(fmt::format("lower bound {}, but a plan of cost {} exists{}",
                                      progress.lower_bound, optimum_.cost,
                                      holding_.empty() ? "" : " and a live node holds it"));
}

void PlantedOptimum::on_infeasible(std::string_view reason) {
  complaints_.push_back(fmt::format("'{}', but a plan of cost {} exists", reason, optimum_.cost));
}

}  // namespace grove::detail::fuzz
