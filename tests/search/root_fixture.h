// SPDX-License-Identifier: MIT
// A root node with the objects that tests need to view or branch it.
#pragma once

#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "search/node_view.h"
#include "search/result_cache.h"
#include "search/single_tree.h"
#include "tests/support/instances.h"

namespace grove::detail::testing {

struct RootFixture {
  RootFixture(const std::vector<std::string>& rows, const std::vector<AgentSpec>& agents,
              const SearchOptions& search_options = {Techniques::defaults(), 0, true})
      : RootFixture(instance_of(rows, agents), search_options) {}
  explicit RootFixture(Instance given,
                       const SearchOptions& search_options = {Techniques::defaults(), 0, true})
      : options(search_options),
        instance(std::move(given)),
        problem(instance, limits),
        stops(instance, problem.distances),
        forest(problem, stops, pool, limits),
        root(forest.next_root()),
        planner(problem, stops),
        memory(planner, std::make_shared<SharedCache>(), options.tuning.mdd_nodes),
        view(problem, options, memory),
        all(static_cast<std::size_t>(instance.agent_count())) {
    std::iota(all.begin(), all.end(), 0);
    view.enter(root, all);
  }

  // Enters a child of the root in which the first agents take these paths. Each path must be as
  // long as the agent's path at the root.
  void take(const std::vector<std::vector<Position>>& routes) {
    std::vector<Path> paths;
    for (const auto& route : routes) {
      paths.emplace_back();
      for (const Position at : route) paths.back().push_back(instance.grid().cell(at));
    }
    std::vector<NewPath> taken;
    for (const Path& path : paths) taken.push_back({static_cast<AgentIndex>(taken.size()), &path});
    NodeDelta change;
    change.paths = taken;
    change.cost = root->cost();
    view.enter(Node::child(root, change), all);
  }

  SearchOptions options;
  Limits limits;
  Instance instance;
  Problem problem;
  AgentStopsCache stops;
  NodePool pool;
  SingleTree forest;
  NodePtr root;
  PathPlanner planner;
  WorkerCache memory;
  NodeView view;
  std::vector<AgentIndex> all;
};

}  // namespace grove::detail::testing
