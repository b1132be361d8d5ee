// SPDX-License-Identifier: MIT
// Swaps: two agents that must exchange places in a corridor.
#pragma once

#include <span>
#include <vector>

#include "primal/configurations.h"

namespace grove::detail {

// Finds pairs of neighbouring agents that must swap, and where they can. A view of one
// configuration. One thread at a time.
class Swaps {
 public:
  static constexpr AgentIndex kNoAgent = -1;

  // All references must outlive this. `now`: by place, the agent that is there. `to`: by agent, the
  // next state, or kNoState while it is not decided.
  Swaps(const World& world, const std::vector<VisitStages>& agents,
        const std::vector<AgentIndex>& now, const std::vector<State>& to)
      : world_(world), agents_(agents), now_(now), to_(to) {}

  // The agent that `agent`, which prefers to move to `wish`, should pull along backwards instead,
  // so that the two can swap at a junction behind `agent`. Returns kNoAgent if there is none. A
  // partner whose next state is decided cannot be pulled; then `agent` only backs off.
  AgentIndex partner(AgentIndex agent, State wish, std::span<const AgentState> from) const;

 private:
  enum class Need : std::uint8_t {
    kNone,
    kToPass,     // each heads for where the other comes from
    kToGetAtEnd  // one heads further on, the other is at a dead end
  };

  // An agent on `back` faces an agent on `front`.
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
