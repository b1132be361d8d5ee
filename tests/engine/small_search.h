// SPDX-License-Identifier: MIT
// A small search for unit tests of the engine: nodes constructed by hand below a real root, and
// scripted replacements for the other components.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/components.h"
#include "engine/live_nodes.h"
#include "engine/run_observer.h"
#include "engine/shared_bounds.h"
#include "search/single_tree.h"
#include "tests/support/instances.h"

namespace grove::detail::testing {

// Two agents that must pass each other in a bay. The sum of their individual costs is 8; the
// optimum is 11.
inline Instance two_in_a_bay() {
  return instance_of({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}});
}

// A search on an instance, by default two_in_a_bay(), with its root and its live nodes.
struct SmallSearch {
  explicit SmallSearch(Instance the_instance = two_in_a_bay())
      : instance(std::move(the_instance)), root(forest.next_root()) {}

  NodePtr child(Cost bound, std::uint32_t conflicts = 0) {
    NodeDelta change;
    change.cost = change.bound = bound;
    change.conflicts = conflicts;
    return Node::child(root, change);
  }

  Limits limits;
  Instance instance;
  Problem problem{instance, limits};
  AgentStopsCache stops{instance, problem.distances};
  LocalNodes nodes;
  SingleTree forest{problem, stops, nodes.pool, limits};
  NodePtr root;
};

// Bounds whose values the test sets. prove() can raise `bound`; post() only records the plan.
struct ScriptedBounds : SharedBounds {
  bool over() const override { return is_over; }
  Cost cutoff() const override { return incumbent ? incumbent->cost : kInfiniteCost; }
  std::optional<Plan> plan_below(Cost cost) const override {
    return cutoff() < cost ? incumbent : std::nullopt;
  }
  Cost lower_bound() const override { return bound; }
  void post(Plan plan, PlanSource source) override {
    live_when_posted = nodes ? nodes->frontier.live() : 0;
    posted.emplace_back(std::move(plan), source);
  }
  void prove(Cost proven, ComponentId) override { bound = std::max(bound, proven); }
  void nodes_changed() override { live_when_changed = nodes ? nodes->frontier.live() : 0; }

  bool is_over = false;
  std::optional<Plan> incumbent;
  Cost bound = 0;
  std::vector<std::pair<Plan, PlanSource>> posted;
  const LocalNodes* nodes = nullptr;  // sampled in post() and nodes_changed()
  std::size_t live_when_posted = 0;
  std::size_t live_when_changed = 0;
};

// Counts the calls of instantiate_due_tree(), refill_nodes() and prepare_tree().
struct CountingSource : TreeSupply {
  void instantiate_due_tree() override { ++due; }
  void refill_nodes() override {
    ++refills;
    if (next) nodes->push(std::exchange(next, nullptr));
  }
  bool claim_preparation() override { return std::exchange(may_prepare, false); }
  void prepare_tree() override { ++prepared; }

  int due = 0;
  int refills = 0;
  bool may_prepare = false;
  int prepared = 0;
  LocalNodes* nodes = nullptr;
  NodePtr next;  // pushed by the next call of refill_nodes()
};

struct CountingObserver : WorkObserver {
  void expanded(const NodePtr& node, const Expansion&, int) override {
    ++expansions;
    last_cost = node->cost();
  }
  void evicted(std::span<const NodePtr> nodes) override {
    for (const NodePtr& node : nodes) evicted_bounds.push_back(node->bound());
  }
  void worked() override { ++work_items; }

  int expansions = 0;
  Cost last_cost = 0;  // of the node expanded last
  int work_items = 0;
  std::vector<Cost> evicted_bounds;
};

}  // namespace grove::detail::testing
