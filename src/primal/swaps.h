// SPDX-License-Identifier: MIT
// Two agents that meet where neither can step aside.
#pragma once

#include <span>
#include <vector>

#include "primal/configurations.h"

namespace grove::detail {

// Sees which pairs of neighbours must change places and where. A view of one configuration.
class Swaps {
 public:
  static constexpr AgentIndex kNobody = -1;

  // All must outlive this. `now`: by place, who is there. `to`: by agent, the next state; kNoState
  // while it is not decided.
  Swaps(const World& world, const std::vector<VisitStages>& agents,
        const std::vector<AgentIndex>& now, const std::vector<State>& to)
      : world_(world), agents_(agents), now_(now), to_(to) {}

  // Whom `agent`, which would like to move to `wish`, should pull along backwards instead, so that
  // the two can change places at a junction behind it; kNobody. A partner whose next cell is
  // decided cannot be pulled: then backing off is all there is to do.
  AgentIndex partner(AgentIndex agent, State wish, std::span<const Standing> from) const;

 private:
  enum class Need : std::uint8_t {
    kNone,
    kToPass,     // each wants to go where the other comes from
    kToGetAtEnd  // one wants to go on, the other has nowhere to go
  };

  // An agent on `back` that faces one on `front`.
  struct Pair {
    State back;
    State front;
  };

  bool nearer(AgentIndex agent, std::span<const Standing> from, State a, State b) const;
  Need need(AgentIndex pusher, AgentIndex pushed, Pair pair, std::span<const Standing> from) const;
  bool is_possible(Pair pair, std::span<const Standing> from) const;
  bool is_plugged(State cell, std::span<const Standing> from) const;
  int ways_on(Pair pair, std::span<const Standing> from, State& way) const;

  const World& world_;
  const std::vector<VisitStages>& agents_;
  const std::vector<AgentIndex>& now_;
  const std::vector<State>& to_;
};

}  // namespace grove::detail
