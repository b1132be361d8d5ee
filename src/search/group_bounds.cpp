// SPDX-License-Identifier: MIT
// Group bounds that are sent together with nodes.
//
// *Problem.* A rank that receives a node without the cached bounds of its pairs has to compute all
// of them again. This takes as much effort as at the root; with the cached bounds only one or two
// pairs are left to examine. If many workers expanded few nodes each, it would be most of their
// effort. A node is therefore sent with the bounds that are known for it (*findings*).
//
// *Claim: a finding holds at the receiver as it does at the sender.* It is a statement about agents
// under sets of constraints and about nothing else, and both sides have the same constraints; see
// wdg_heuristic.cpp. The receiver numbers subproblems differently, so a finding names its agents
// and a node instead of subproblem numbers.
#include "search/group_bounds.h"

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>
#include <utility>

namespace grove::detail {
namespace {

using Id = SubproblemTable::Id;
using ExcessBound = DependencyTable::ExcessBound;

bool is_informative(const ExcessBound& known) {
  return known.exact || known.excess > 0 || known.expansions > 0;
}

// Computes the numbers of the subproblems of all agents at a node.
class SubproblemsAt {
 public:
  explicit SubproblemsAt(SharedCache& memory) : memory_(memory) {}

  const std::vector<Id>& of(const Node& node) {
    node.constraints(constraints_);
    ids_.resize(constraints_.size());
    for (std::size_t agent = 0; agent < ids_.size(); ++agent) {
      canonical(constraints_[agent]);
      ids_[agent] = memory_.subproblems.id(static_cast<AgentIndex>(agent),
                                           *node.tree().orders[agent], constraints_[agent]);
    }
    return ids_;
  }

 private:
  SharedCache& memory_;
  std::vector<std::vector<Constraint>> constraints_;
  std::vector<Id> ids_;
};

// Collects the known bounds of one node after the other, each bound once.
class Collector {
 public:
  explicit Collector(SharedCache& memory) : memory_(memory), subproblems_(memory) {}

  void load_subproblems(const Node& node, std::int32_t place, std::vector<GroupBound>& findings) {
    const std::vector<Id>& ids = subproblems_.of(node);
    is_new_.resize(ids.size());
    for (std::size_t agent = 0; agent < ids.size(); ++agent)
      is_new_[agent] = seen_.insert(ids[agent]).second;
    for (std::size_t a = 0; a < ids.size(); ++a)
      for (std::size_t b = a + 1; b < ids.size(); ++b) {
        if (!is_new_[a] && !is_new_[b]) continue;
        const ExcessBound known = memory_.excesses.of_pair(ids[a], ids[b]);
        if (is_informative(known))
          findings.push_back(
              {place, {static_cast<AgentIndex>(a), static_cast<AgentIndex>(b)}, known});
      }
    memory_.excesses.groups_at(ids, [&](const auto& group) {
      if (is_informative(group.known) &&
          std::ranges::any_of(group.agents, [&](AgentIndex agent) { return is_new_[agent]; }))
        findings.push_back({place, group.agents, group.known});
    });
  }

 private:
  SharedCache& memory_;
  SubproblemsAt subproblems_;
  std::set<Id> seen_;
  std::vector<bool> is_new_;  // by AgentIndex: whether no earlier node has this subproblem
};

void require_place(const GroupBound& finding, std::size_t nodes) {
  if (finding.node < 0 || static_cast<std::size_t>(finding.node) >= nodes)
    throw std::invalid_argument("an excess bound must belong to a node of its batch");
}

void require_agents(const GroupBound& finding, std::size_t agents) {
  const auto& group = finding.agents;
  const bool ascend = std::ranges::adjacent_find(group, std::greater_equal<>()) == group.end();
  if (group.size() < 2 || !ascend || group.front() < 0 ||
      static_cast<std::size_t>(group.back()) >= agents || finding.known.excess < 0)
    throw std::invalid_argument(
        "an excess bound must name agents of the instance in ascending order");
}

}  // namespace

std::vector<GroupBound> group_bounds_of(std::span<const NodePtr> nodes, SharedCache& memory) {
  std::vector<GroupBound> findings;
  if (memory.excesses.bytes() == 0) return findings;
  Collector collector(memory);
  for (std::size_t place = 0; place < nodes.size(); ++place)
    collector.load_subproblems(*nodes[place], static_cast<std::int32_t>(place), findings);
  return findings;
}

void merge(std::span<const GroupBound> findings, std::span<const NodePtr> nodes,
           SharedCache& memory) {
  SubproblemsAt subproblems(memory);
  const Node* at = nullptr;  // the node whose subproblems are in `ids`
  std::vector<Id> ids;
  std::vector<Id> key;
  for (const GroupBound& finding : findings) {
    require_place(finding, nodes.size());
    const Node* node = nodes[static_cast<std::size_t>(finding.node)].get();
    if (!node) continue;
    require_agents(finding, node->tree().orders.size());
    if (node != at) ids = subproblems.of(*node);
    at = node;
    key.clear();
    for (const AgentIndex agent : finding.agents) key.push_back(ids[agent]);
    if (key.size() > 2)
      memory.excesses.merge_group(finding.agents, key, finding.known);
    else
      memory.excesses.merge_pair(key[0], key[1], finding.agents[1], finding.known);
  }
}

}  // namespace grove::detail
