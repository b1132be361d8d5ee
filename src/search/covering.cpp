// SPDX-License-Identifier: MIT
// Covering bound: the least sum of nonnegative integers, one per agent, that fulfils all
// statements.
//
// Each component of the hypergraph of statements is solved separately. For B = greedy bound, greedy
// bound + 1, ... a depth-first search decides whether there is a solution with a sum of at most B.
// It chooses a statement that is not fulfilled and branches on the agent whose integer rises by
// one. After the branch for agent i, later siblings may not raise i again, so each solution is
// tried once. A branch is cut off if its greedy bound exceeds what is left of B. The first B with a
// solution is the optimum. If the step limit is reached, the current B is a bound, because all
// smaller values were refuted.
//
// The greedy bound is the sum of the excesses of statements that are chosen one after the other
// such that no two share an agent; every solution has at least this sum. If it is large (a
// statement can have infinite excess), it is returned as the result, because the search would be as
// deep as B is large.
#include "search/covering.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "model/assert.h"
#include "model/omega.h"

namespace grove::detail {
namespace {

constexpr Cost kMaxCoveringCost = 256;
constexpr std::int64_t kCallsPerPoll = 256;

// A statement over the agents 0 .. count - 1 of its component.
struct Statement {
  std::vector<int> agents;
  Cost due;  // the part of its excess that is not fulfilled yet
};

class Component {
 public:
  Component(std::vector<Statement> statements, int agents, std::int64_t& steps,
            const Limits& limits)
      : statements_(std::move(statements)),
        frozen_(agents, 0),
        used_(agents),
        steps_(steps),
        limits_(limits) {
    std::ranges::sort(statements_, std::greater(), &Statement::due);
    GROVE_ASSERT(
        statements_.back().due > 0 &&
            std::ranges::none_of(statements_, [](const Statement& s) { return s.agents.empty(); }),
        "a statement gives some agents a positive excess");
  }

  Cost solve() {
    const Cost total = due();
    Cost sum = greedy();
    while (sum <= kMaxCoveringCost && !fulfil(sum) && steps_ > 0) ++sum;
    GROVE_ASSERT(due() == total && std::ranges::count(frozen_, 0) == std::ssize(frozen_),
                 "the search for a covering restores all statements and agents");
    GROVE_ASSERT(sum >= statements_.front().due && sum <= total,
                 "a covering costs at least the largest excess and at most the sum of all");
    return sum;
  }

 private:
  // Sum of the excesses that are not fulfilled; at most kInfiniteCost.
  Cost due() const {
    Cost sum = 0;
    for (const Statement& s : statements_) sum = std::min(sum + s.due, kInfiniteCost);
    return sum;
  }

  Cost greedy() {
    std::fill(used_.begin(), used_.end(), false);
    Cost sum = 0;
    for (const Statement& s : statements_) {
      if (s.due <= 0 || std::ranges::any_of(s.agents, [&](int a) { return used_[a]; })) continue;
      sum = std::min(sum + s.due, kInfiniteCost);
      for (int a : s.agents) used_[a] = true;
    }
    return sum;
  }

  // Returns whether all statements can be fulfilled by raising the integers of agents that are not
  // frozen by at most `left` in total; also returns true once the step limit or a limit of the run
  // is reached.
  bool fulfil(Cost left) {
    steps_ -= static_cast<std::int64_t>(statements_.size());
    if (++calls_ % kCallsPerPoll == 0 && limits_.stop_requested()) steps_ = 0;
    if (steps_ <= 0) return true;
    if (greedy() > left) return false;
    const auto most = std::ranges::max_element(statements_, {}, &Statement::due);
    if (most->due <= 0) return true;
    const std::vector<int> agents = most->agents;
    std::vector<int> tried;
    bool found = false;
    for (int agent : agents) {
      if (found || frozen_[agent] > 0) continue;
      raise(agent, 1);
      found = fulfil(left - 1);
      raise(agent, -1);
      ++frozen_[agent];
      tried.push_back(agent);
    }
    for (int agent : tried) --frozen_[agent];
    return found;
  }

  void raise(int agent, Cost amount) {
    for (Statement& s : statements_)
      if (std::ranges::count(s.agents, agent) > 0) s.due -= amount;
  }

  std::vector<Statement> statements_;
  std::vector<int> frozen_;
  std::vector<bool> used_;
  std::int64_t& steps_;
  const Limits& limits_;
  std::int64_t calls_ = 0;
};

// Union-find: maps each agent to the smallest agent of its component.
class Components {
 public:
  explicit Components(AgentIndex agents) : parent_(static_cast<std::size_t>(agents)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  AgentIndex find(AgentIndex agent) {
    while (parent_[agent] != agent) agent = parent_[agent] = parent_[parent_[agent]];
    return agent;
  }
  void join(AgentIndex a, AgentIndex b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<AgentIndex> parent_;
};

Cost solve_component(std::span<const GroupExcess* const> statements, std::int64_t& steps,
                     const Limits& limits) {
  std::vector<AgentIndex> agents;
  for (const GroupExcess* s : statements)
    agents.insert(agents.end(), s->agents.begin(), s->agents.end());
  std::ranges::sort(agents);
  agents.erase(std::unique(agents.begin(), agents.end()), agents.end());
  std::vector<Statement> local;
  for (const GroupExcess* s : statements) {
    Statement& statement = local.emplace_back();
    statement.due = s->excess;
    for (AgentIndex a : s->agents)
      statement.agents.push_back(
          static_cast<int>(std::ranges::lower_bound(agents, a) - agents.begin()));
  }
  return Component(std::move(local), static_cast<int>(agents.size()), steps, limits).solve();
}

}  // namespace

Cost covering_bound(std::span<const GroupExcess> statements, std::int64_t steps,
                    const Limits& limits) {
  AgentIndex agents = 0;
  for (const GroupExcess& s : statements) agents = std::max(agents, std::ranges::max(s.agents) + 1);
  Components components(agents);
  for (const GroupExcess& s : statements)
    for (AgentIndex a : s.agents) components.join(s.agents.front(), a);

  std::vector<const GroupExcess*> sorted;
  for (const GroupExcess& s : statements) sorted.push_back(&s);
  const auto root = [&](const GroupExcess* s) { return components.find(s->agents.front()); };
  std::ranges::stable_sort(sorted, {}, root);
  Cost sum = 0;
  for (auto begin = sorted.begin(); begin != sorted.end();) {
    const auto end = std::find_if(begin, sorted.end(),
                                  [&](const GroupExcess* s) { return root(s) != root(*begin); });
    sum = std::min(sum + solve_component({begin, end}, steps, limits), kInfiniteCost);
    begin = end;
  }
  return sum;
}

}  // namespace grove::detail
