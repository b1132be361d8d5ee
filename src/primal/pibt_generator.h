// SPDX-License-Identifier: MIT
// One joint step of all agents.
#pragma once

#include <span>
#include <vector>

#include "primal/configurations.h"
#include "primal/splitmix64.h"
#include "primal/swaps.h"

namespace grove::detail {

// Where an agent is told to be after the step.
struct LacamConstraint {
  AgentIndex agent;
  State state;
};

// Makes joint steps by priority inheritance with backtracking (PIBT). Workspace of one thread.
class PibtGenerator {
 public:
  // `world` and `agents` must outlive this.
  PibtGenerator(const World& world, std::vector<VisitStages>& agents);

  // A step from `from` without collisions in which every order is obeyed; agents come earlier in
  // `priority` the more they matter. The result, by agent, holds until the next call; empty if none
  // was found, which is certain only if every agent has an order.
  std::span<const State> step(std::span<const Standing> from, std::span<const AgentIndex> priority,
                              std::span<const LacamConstraint> orders, SplitMix64& dice);

 private:
  static constexpr AgentIndex kNobody = Swaps::kNobody;

  struct Candidate {
    State state;
    std::int64_t key;
  };

  bool obey(std::span<const LacamConstraint> orders);
  bool push(AgentIndex agent);
  bool try_candidates(AgentIndex agent, std::size_t first);
  void pull(AgentIndex agent, State state);
  void rank_candidates(AgentIndex agent);
  bool collides(AgentIndex agent, State state) const;
  void move(AgentIndex agent, State state);
  void clear();

  const World& world_;
  std::vector<VisitStages>& agents_;
  std::vector<AgentIndex> now_;        // by place: who is there
  std::vector<AgentIndex> later_;      // by place: who will be there
  std::vector<State> to_;              // by agent; kNoState: not decided
  std::vector<Candidate> candidates_;  // of those who are choosing, one after the other
  Swaps swaps_;
  std::span<const Standing> from_;
  SplitMix64* dice_ = nullptr;
};

}  // namespace grove::detail
