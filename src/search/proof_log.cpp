// SPDX-License-Identifier: MIT
#include "search/proof_log.h"

#include <functional>
#include <ranges>

#include "model/assert.h"
#include "model/hash.h"

namespace grove::detail {
namespace {

// Appends the sequence class that a tree fixes for an agent, as constraints.
void add_order(AgentIndex agent, const AgentSequencing& order,
               std::vector<AgentConstraint>& constraints) {
  const SequenceClass& sequences = order.sequences;
  const auto add = [&](std::size_t number, Stop stop, ConstraintKind kind) {
    const auto at = static_cast<Time>(number);
    constraints.push_back({agent, {kNoPlace, stop, at, at, kind}});
  };
  for (std::size_t number = 0; number < sequences.prefix.size(); ++number)
    add(number, sequences.prefix[number], ConstraintKind::kStopIs);
  for (Stop stop = 0; stop < kMaxTasksPerAgent; ++stop)
    if ((sequences.forbidden_next >> stop & 1) != 0)
      add(sequences.prefix.size(), stop, ConstraintKind::kStopIsNot);
}

}  // namespace

ProofKey proof_key(const Tree& tree) {
  ProofKey key = 1;
  for (std::size_t agent = 0; agent < tree.orders.size(); ++agent) {
    const SequenceClass& sequences = tree.orders[agent]->sequences;
    key = hash_combine(key, agent);
    for (const Stop stop : sequences.prefix) key = hash_combine(key, stop);
    key = hash_combine(key, sequences.forbidden_next);
  }
  return key;
}

ProofKey proof_key(const Node& node) {
  std::vector<const AgentConstraint*> added;
  for (const Node* at = &node; !at->is_root(); at = at->parent())
    if (at->added().agent >= 0) added.push_back(&at->added());
  ProofKey key = proof_key(node.tree());
  for (const AgentConstraint* constraint : added | std::views::reverse)
    key = proof_key(key, *constraint);
  return key;
}

ProofKey proof_key(ProofKey parent, const AgentConstraint& added) {
  const Constraint& c = added.constraint;
  for (const std::int64_t value : {added.agent, c.cell, c.from, c.begin, c.end})
    parent = hash_combine(parent, static_cast<std::uint64_t>(value));
  return hash_combine(parent, static_cast<std::uint64_t>(c.kind));
}

ProofKey ProofLemma::key() const {
  ProofKey key = hash_combine(2, static_cast<std::uint64_t>(bound));
  for (const AgentIndex agent : agents) key = hash_combine(key, static_cast<std::uint64_t>(agent));
  for (const AgentConstraint& constraint : constraints) key = proof_key(key, constraint);
  return key;
}

ProofLemma lemma_at(const NodeView& view, std::span<const AgentIndex> group, Cost excess) {
  GROVE_ASSERT(
      group.size() > 1 && std::ranges::adjacent_find(group, std::greater_equal<>()) == group.end(),
      "a lemma is about two or more agents, in ascending order");
  ProofLemma lemma;
  lemma.agents.assign(group.begin(), group.end());
  for (const AgentIndex agent : group) {
    lemma.bound += view.cost_of(agent);
    add_order(agent, view.order(agent), lemma.constraints);
    for (const Constraint& constraint : view.constraints(agent))
      lemma.constraints.push_back({agent, constraint});
  }
  lemma.bound = std::min(kInfiniteCost, lemma.bound + excess);
  return lemma;
}

}  // namespace grove::detail
