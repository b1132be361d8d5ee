// SPDX-License-Identifier: MIT
// Why a search that loses the plan is wrong although others may be as cheap: pruning by bound is
// the gate's business alone, and it never prunes below the incumbent's cost. Everything else -
// splitting a conflict, discarding a child, choosing the trees - must lose no plan at all.
#include "tests/fuzz/planted_optimum.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "tests/support/obeys.h"

namespace grove::fuzz {
namespace {

bool in_class(const SequenceClass& sequences, const Sequence& sequence) {
  const std::size_t fixed = sequences.prefix.size();
  if (!std::equal(sequences.prefix.begin(), sequences.prefix.end(), sequence.begin())) return false;
  return fixed == sequence.size() || (sequences.forbidden_next >> sequence[fixed] & 1) == 0;
}

}  // namespace

bool realizes(const Instance& instance, AgentIndex agent, const Path& path,
              const Sequence& sequence) {
  const auto cell = [&](Stop stop) {
    return instance.task(instance.agent(agent).tasks[stop]).cell;
  };
  auto visit = path.begin();
  for (const Stop stop : sequence) {
    visit = std::find(visit, path.end(), cell(stop));
    if (visit == path.end()) return false;
  }
  return instance.agent(agent).goal || path.back() == cell(sequence.back());
}

bool PlantedOptimum::order_allows(const AgentOrder& order, AgentIndex agent) const {
  Sequence sequence(instance_.agent(agent).tasks.size());
  std::iota(sequence.begin(), sequence.end(), Stop{0});
  do {
    if (in_class(order.sequences, sequence) &&
        realizes(instance_, agent, optimum_.agents[agent].path, sequence))
      return true;
  } while (std::ranges::next_permutation(sequence).found);
  return false;
}

bool PlantedOptimum::held_by(const Node& node) const {
  std::vector<Constraint> constraints;
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
    if (!order_allows(*node.tree().orders[agent], agent)) return false;
    constraints.clear();
    node.constraints(agent, constraints);
    for (const Constraint& constraint : constraints)
      if (!testing::obeys(instance_.grid(), optimum_.agents[agent].path, constraint)) return false;
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

void PlantedOptimum::on_expanded(const NodePtr& node, const Expansion& expansion) {
  if (holding_.erase(node.get()) == 0) return;
  bool kept = expansion.plan && expansion.plan->cost <= optimum_.cost;
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

// What the search had proven by then it need not take back.
void PlantedOptimum::on_evicted(const NodePtr& node) {
  if (holding_.erase(node.get()) > 0)
    evicted_bound_ = std::min(evicted_bound_, std::max(node->bound(), claimed_));
}

void PlantedOptimum::on_event(RunEvent, const Progress& progress) {
  claimed_ = progress.lower_bound;
  found_ = progress.incumbent && *progress.incumbent <= optimum_.cost;
  if (found_) holding_.clear();
  if (!found_ && progress.lower_bound > evicted_bound_)
    complaints_.push_back(
        fmt::format("lower bound {}, but a node of bound {} that held a plan was given up",
                    progress.lower_bound, evicted_bound_));
  if (progress.lower_bound > optimum_.cost)
    complaints_.push_back(fmt::format("lower bound {}, but a plan of cost {} exists{}",
                                      progress.lower_bound, optimum_.cost,
                                      holding_.empty() ? "" : " and a live node holds it"));
}

void PlantedOptimum::on_infeasible(std::string_view reason) {
  complaints_.push_back(fmt::format("'{}', but a plan of cost {} exists", reason, optimum_.cost));
}

}  // namespace grove::fuzz
