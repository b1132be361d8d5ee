// SPDX-License-Identifier: MIT
// Swaps: detects two agents that must pass each other in a corridor.
#pragma once

#include <span>
#include <vector>

#include "primal/configurations.h"

namespace grove::detail {

// Finds pairs of neighbouring agents that must swap, and tests whether they can. A view of one
// configuration. One thread at a time.
class Swaps {
 public:
  static constexpr AgentIndex kNoAgent = -1;

  // All references must outlive this object. `now`: by place, the agent there, or kNoAgent. `to`:
  // by agent, the next state, or kNoState if it is not decided yet.
  Swaps(const World& world, const std::vector<VisitStages>& agents,
        const std::vector<AgentIndex>& now, const std::vector<State>& to)
      : world_(world), agents_(agents), now_(now), to_(to) {}

  // `agent` prefers to move to `wish`. Returns the agent that it should instead pull backwards, so
  // that the two can swap at a junction behind `agent`; or kNoAgent if no swap is needed or
  // possible. If the next state of the returned agent is already decided, that agent cannot be
  // pulled, and `agent` only backs off.
  AgentIndex partner(AgentIndex agent, State wish, std::span<const AgentState> from) const;

 private:
  enum class Need : std::uint8_t {
    kNone,
    kToPass,  // each agent heads for the side from which the other comes
    kDeadEnd  // one agent heads on to a dead end in which the other is
  };

  // Places of two agents: the one on `back` pushes the one on `front`.
  struct Pair {
    State back;
    State front;
  };

  bool nearer(AgentIndex agent, std::span<const AgentState> from, State a, State b) const;
  Need need(AgentIndex pusher, AgentIndex pushed, Pair pair,
            std::span<const AgentState> from) const;
  bool is_possible(Pair pair, std::span<const AgentState> from) const;
  bool is_plugged(State cell, std::span<const AgentState> from) const;
  int ways_on(Pair pair, std::span<const AgentState> from, State& way) const;

  const World& world_;
  const std::vector<VisitStages>& agents_;
  const std::vector<AgentIndex>& now_;
  const std::vector<State>& to_;
};

}  // namespace grove::detail
