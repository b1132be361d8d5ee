// SPDX-License-Identifier: MIT
// Moves are chosen agent by agent, in ascending order of delta_f. The sum of the largest delta_f of
// the later agents decides whether a prefix of moves can still lead to a successor above the
// expanded budget.
#include "joint/joint_moves.h"

#include <algorithm>

#include "joint/joint_states.h"
#include "model/assert.h"

namespace grove::detail {

JointMoves::JointMoves(const Instance& instance, std::span<const AgentGraph> agents)
    : may_follow_(instance.may_follow()),
      agents_(agents),
      from_on_(static_cast<std::size_t>(instance.world().place_count()), kNoAgent),
      to_on_(from_on_) {}

Time JointMoves::generate(const Node* nodes, std::int32_t cost, Time expanded_budget, Time budget) {
  const std::size_t size = agents_.size();
  successors_.clear();
  successor_nodes_.clear();
  from_.assign(nodes, nodes + size);
  to_.resize(size);
  expanded_budget_ = expanded_budget;
  budget_ = budget;
  next_budget_ = kNever;
  max_remaining_delta_f_.assign(size + 1, 0);
  for (std::size_t i = size; i-- > 0;)
    max_remaining_delta_f_[i] =
        max_remaining_delta_f_[i + 1] + agents_[i].moves(from_[i]).back().delta_f;
  for (std::size_t i = 0; i < size; ++i) {
    GROVE_ASSERT(from_on_[place(i, from_)] == kNoAgent, "a joint state has no vertex conflict");
    from_on_[place(i, from_)] = static_cast<std::int8_t>(i);
  }
  choose(0, 0, cost, 0);
  for (std::size_t i = 0; i < size; ++i) from_on_[place(i, from_)] = kNoAgent;
  GROVE_ASSERT(next_budget_ > budget_, "the next budget of a joint state exceeds the current one");
  return next_budget_;
}

// Chooses moves for `agent` and all later agents. The moves of the earlier agents are chosen and
// lead to `cost`.
void JointMoves::choose(std::size_t agent, Time delta_f, std::int32_t cost,
                        std::int32_t individual_costs) {
  if (agent == agents_.size()) {
    GROVE_ASSERT(delta_f > expanded_budget_ && delta_f <= budget_,
                 "a successor is generated in only one expansion of its parent");
    successor_nodes_.insert(successor_nodes_.end(), to_.begin(), to_.end());
    successors_.push_back(
        {JointStates::hash_of(to_.data(), agents_.size()), cost, individual_costs});
    return;
  }
  const AgentGraph& graph = agents_[agent];
  const std::size_t here = place(agent, from_);
  for (const AgentGraph::Move& move : graph.moves(from_[agent])) {
    const Time sum = delta_f + move.delta_f;
    if (sum + max_remaining_delta_f_[agent + 1] <= expanded_budget_) continue;
    const auto there = static_cast<std::size_t>(graph.place(move.to));
    if (collides(agent, here, there)) continue;
    if (sum > budget_) {
      next_budget_ = std::min(next_budget_, sum);
      return;  // moves are sorted by delta_f
    }
    to_[agent] = move.to;
    to_on_[there] = static_cast<std::int8_t>(agent);
    choose(agent + 1, sum, cost + (graph.rests(move.to) ? 0 : 1),
           individual_costs + graph.to_go(move.to));
    to_on_[there] = kNoAgent;
  }
}

// True if the move collides with that of an earlier agent or, where following is forbidden, leads
// to the current place of any other agent.
bool JointMoves::collides(std::size_t agent, std::size_t here, std::size_t there) const {
  if (to_on_[there] != kNoAgent) return true;
  if (here == there) return false;
  const std::int8_t who = from_on_[there];
  if (who == kNoAgent) return false;
  if (!may_follow_) return true;
  return who < static_cast<std::int8_t>(agent) && place(static_cast<std::size_t>(who), to_) == here;
}

}  // namespace grove::detail
