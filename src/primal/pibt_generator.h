// SPDX-License-Identifier: MIT
// PIBT as the configuration generator of LaCAM: joint steps of all agents.
#pragma once

#include <span>
#include <vector>

#include "model/random.h"
#include "primal/configurations.h"
#include "primal/swaps.h"

namespace grove::detail {

// LaCAM constraint: prescribes the state of an agent after a joint step.
struct LacamConstraint {
  AgentIndex agent;
  State state;
};

// Makes joint steps by priority inheritance with backtracking (PIBT). One thread at a time.
class PibtGenerator {
 public:
  // `world` and `agents` must outlive this object.
  PibtGenerator(const World& world, std::vector<VisitStages>& agents);

  // Makes a collision-free joint step from `from` that satisfies all constraints in `constraints`.
  // `priority`: all agents, highest priority first. Returns the new states by agent, valid until
  // the next call, or an empty span if PIBT finds no such step. This proves that no such step
  // exists only if every agent has a constraint.
  std::span<const State> step(std::span<const AgentState> from,
                              std::span<const AgentIndex> priority,
                              std::span<const LacamConstraint> constraints, SplitMix64& dice);

 private:
  static constexpr AgentIndex kNoAgent = Swaps::kNoAgent;

  struct Candidate {
    State state;
    std::int64_t key;
  };

  bool apply(std::span<const LacamConstraint> constraints);
  bool push(AgentIndex agent);
  bool try_candidates(AgentIndex agent, std::size_t first);
  void pull(AgentIndex agent, State state);
  void rank_candidates(AgentIndex agent);
  bool collides(AgentIndex agent, State state) const;
  bool is_possible(AgentIndex agent) const;
  void move(AgentIndex agent, State state);
  void clear();

  const World& world_;
  std::vector<VisitStages>& agents_;
  std::vector<AgentIndex> now_;        // by place: the agent that is there
  std::vector<AgentIndex> later_;      // by place: the agent that will be there
  std::vector<State> to_;              // by agent; kNoState: not decided
  std::vector<Candidate> candidates_;  // stack: candidates of all agents that are choosing
  Swaps swaps_;
  std::span<const AgentState> from_;
  SplitMix64* dice_ = nullptr;
};

}  // namespace grove::detail
