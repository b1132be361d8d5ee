// SPDX-License-Identifier: MIT
// *Claim: a learned bound holds in every process of the run.* *Proof.* It depends only on agents,
// their sequence classes and their constraint sets. It depends neither on a node nor on an
// incumbent: a search that ends at a cutoff leaves the bound that it has proven by then, which
// holds for any cutoff (child_costs.cpp, wdg_heuristic.cpp). A tree number stands for the same
// sequence classes in every process of a run, and constraints are values. The number of a
// subproblem differs between processes and is not sent.
//
// *Consequence.* Learned bounds can arrive late, twice, in any order or never. This affects only
// the running time.
#include "search/learned_bounds.h"

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <stdexcept>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kBytesPerConstraint = 6;  // approximate
// Weight of a positive excess, which raises bounds, whereas an excess of 0 only saves a
// computation. *Measured* with 128 ranks on room-32-32-4 with 40 agents: search overhead 38 % with
// weight 1, 36 % with weight 4 and with weight 16.
constexpr double kPositiveExcessWeight = 4;

std::size_t bytes_of_constraints(const LearnedBound& fact) {
  std::size_t sum = 0;
  for (const SubproblemRecord& s : fact.agents) sum += s.constraints.bytes.size();
  return sum;
}

// Collects the learned bounds all of whose agents belong to trees in the index.
class BoundCollector {
 public:
  BoundCollector(const SharedCache& memory, const TreeIndex& trees)
      : memory_(memory), trees_(trees) {}

  void add(std::span<const SubproblemTable::Id> ids, SubproblemTable::CostBound cost,
           DependencyTable::ExcessBound excess) {
    LearnedBound fact{{}, cost, excess};
    for (const SubproblemTable::Id id : ids) {
      AgentSubproblem subproblem = memory_.subproblems.subproblem(id);
      const Tree* tree = trees_.of(*subproblem.order);
      if (tree == nullptr) return;
      GROVE_CHECK(tree->orders[subproblem.agent].get() == subproblem.order,
                  "a tree found for a subproblem fixes its agent's sequence class");
      GROVE_CHECK(fact.agents.empty() || fact.agents.back().agent < subproblem.agent,
                  "a learned bound names its agents in ascending order");
      fact.agents.push_back({tree->number, subproblem.agent, std::move(subproblem.constraints)});
    }
    facts_.push_back(std::move(fact));
  }

  std::vector<LearnedBound> all() { return std::move(facts_); }

 private:
  const SharedCache& memory_;
  const TreeIndex& trees_;
  std::vector<LearnedBound> facts_;
};

void require(bool possible) {
  if (!possible)
    throw std::invalid_argument(
        "a learned bound must name agents of the instance in ascending order");
}

void require_order(const LearnedBound& fact) {
  const auto& agents = fact.agents;
  require(!agents.empty() && fact.excess.excess >= 0 && fact.cost.lower_bound >= 0 &&
          std::ranges::adjacent_find(agents, std::greater_equal<>(), &SubproblemRecord::agent) ==
              agents.end());
}

}  // namespace

double LearnedBound::utility() const {
  const double value = (1.0 + excess.expansions) * (excess.excess > 0 ? kPositiveExcessWeight : 1);
  return value / static_cast<double>(kBytesPerConstraint + bytes_of_constraints(*this));
}

void TreeIndex::add(const Tree& tree) {
  by_number_.emplace(tree.number, &tree);
  for (const auto& order : tree.orders) by_order_.emplace(order.get(), &tree);
}

const Tree* TreeIndex::of(const AgentSequencing& order) const {
  const auto found = by_order_.find(&order);
  return found == by_order_.end() ? nullptr : found->second;
}

const Tree* TreeIndex::numbered(std::uint32_t number) const {
  const auto found = by_number_.find(number);
  return found == by_number_.end() ? nullptr : found->second;
}

std::vector<LearnedBound> learned_bounds_of(const NewEntries& news, const SharedCache& memory,
                                            const TreeIndex& trees) {
  BoundCollector collector(memory, trees);
  for (const auto& [id, known] : news.costs) collector.add(std::array{id}, known, {});
  for (const auto& pair : news.pairs)
    collector.add(std::array{pair.first, pair.second}, {}, pair.known);
  for (const auto& group : news.groups) collector.add(group.subproblems, {}, group.known);
  return collector.all();
}

void merge(LearnedBound fact, const TreeIndex& trees, SharedCache& memory) {
  require_order(fact);
  std::vector<SubproblemTable::Id> ids;
  std::vector<AgentIndex> agents;
  for (auto& [number, agent, constraints] : fact.agents) {
    const Tree* tree = trees.numbered(number);
    if (tree == nullptr) return;
    require(agent >= 0 && static_cast<std::size_t>(agent) < tree->orders.size());
    ids.push_back(
        memory.subproblems.id({tree->orders[agent].get(), agent, std::move(constraints)}));
    agents.push_back(agent);
  }
  if (ids.size() == 1)
    memory.subproblems.merge(ids[0], fact.cost);
  else if (ids.size() == 2)
    memory.excesses.merge_pair(ids[0], ids[1], agents[1], fact.excess);
  else
    memory.excesses.merge_group(agents, ids, fact.excess);
}

}  // namespace grove::detail
