// SPDX-License-Identifier: MIT
#include "search/node_record.h"

#include <algorithm>

#include "model/assert.h"
#include "search/require.h"

namespace grove::detail {
void check(const NodeRecord& record, const Node& root, const Instance& instance) {
  const auto is_agent = [&](AgentIndex agent) {
    return agent >= 0 && agent < instance.agent_count();
  };
  const World& world = instance.world();
  const auto is_place = [&](Place place) { return place >= 0 && place < world.place_count(); };
  for (const AgentConstraint& c : record.constraints)
    require(is_agent(c.agent) && is_place(c.constraint.cell) &&
                (c.constraint.from == kNoPlace || is_place(c.constraint.from)),
            "a node's constraint must be on an agent and places of the instance");
  for (const NodeRecord::Walk& walk : record.paths) {
    require(is_agent(walk.agent) && walk.words.size() == packed_words(world, walk.steps),
            "a node's path must be of an agent of the instance");
    const PackedSteps steps{walk.steps, walk.words.data()};
    require(steps.is_walk(instance.world(), instance.agent(walk.agent).start),
            "a node's path must be a walk on the map");
  }
  require(record.bound >= root.bound() && record.bound >= record.cost,
          "a node's bound must not be below its root's or its cost");
}

NodeRecord record_of(const Node& node) {
  NodeRecord record;
  record.tree = node.tree().number;
  record.cost = node.cost();
  record.bound = node.bound();
  record.conflicts = node.conflicts();
  record.bounded = node.is_bounded();
  for (const Node* at = &node; !at->is_root(); at = at->parent()) {
    if (at->added().agent >= 0) record.constraints.push_back(at->added());
    at->for_each_path([&](AgentIndex agent, const PackedSteps& path) {
      if (std::ranges::count(record.paths, agent, &NodeRecord::Walk::agent) > 0) return;
      record.paths.push_back(
          {agent,
           path.steps,
           {path.words, path.words + packed_words(*node.tree().world, path.steps)}});
    });
  }
  std::ranges::reverse(record.constraints);
  std::ranges::sort(record.paths, {}, &NodeRecord::Walk::agent);
  GROVE_CHECK(
      std::ranges::adjacent_find(record.paths, {}, &NodeRecord::Walk::agent) == record.paths.end(),
      "a record has one path of an agent, that of the deepest node");
  GROVE_CHECK(record.bound >= record.cost, "a record's bound is at least its cost");
  return record;
}

NodePtr node_of(const NodeRecord& record, const NodePtr& root, const Instance& instance) {
  check(record, *root, instance);
  NodePtr node = root;
  for (const AgentConstraint& constraint : record.constraints) {
    NodeDelta change;
    change.added = constraint;
    node = Node::child(node, change);
  }
  std::vector<Path> paths(record.paths.size());
  std::vector<NewPath> changed;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const NodeRecord::Walk& walk = record.paths[i];
    PackedSteps{walk.steps, walk.words.data()}.unpack(instance.world(),
                                                      instance.agent(walk.agent).start, paths[i]);
    changed.push_back({walk.agent, &paths[i]});
  }
  NodeDelta change;
  change.paths = changed;
  change.cost = record.cost;
  change.bound = record.bound;
  change.conflicts = record.conflicts;
  change.bounded = record.bounded;
  NodePtr made = Node::child(node, change);
  GROVE_CHECK(made->bound() == record.bound && made->cost() == record.cost,
              "a node has the bound and the cost of its record");
  return made;
}

}  // namespace grove::detail
