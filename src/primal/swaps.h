// SPDX-License-Identifier: MIT
// Two agents that meet where neither can step aside.
#pragma once

#include <span>
#include <vector>

#include "configurations.h"

namespace grove {

// Sees which pairs of neighbours must change places and where. A view of one configuration.
class Swaps {
 public:
  static constexpr AgentIndex kNobody = -1;

  // All must outlive this. `now`: by cell, who is there. `to`: by agent, the next cell; kNoCell
  // while it is not decided.
  Swaps(const Grid& grid, const std::vector<VisitStates>& agents,
        const std::vector<AgentIndex>& now, const std::vector<Cell>& to)
      : grid_(grid), agents_(agents), now_(now), to_(to) {}

  // Whom `agent`, which would like to move to `wish`, should pull along backwards instead, so that
  // the two can change places at a junction behind it; kNobody. A partner whose next cell is
  // decided cannot be pulled: then backing off is all there is to do.
  AgentIndex partner(AgentIndex agent, Cell wish, std::span<const Place> from) const;

 private:
  enum class Need : std::uint8_t {
    kNone,
    kToPass,     // each wants to go where the other comes from
    kToGetAtEnd  // one wants to go on, the other has nowhere to go
  };

  // An agent on `back` that faces one on `front`.
  struct Pair {
    Cell back;
    Cell front;
  };

  bool nearer(AgentIndex agent, std::span<const Place> from, Cell a, Cell b) const;
  Need need(AgentIndex pusher, AgentIndex pushed, Pair pair, std::span<const Place> from) const;
  bool is_possible(Pair pair, std::span<const Place> from) const;
  bool is_plugged(Cell cell, std::span<const Place> from) const;
  int ways_on(Pair pair, std::span<const Place> from, Cell& way) const;

  const Grid& grid_;
  const std::vector<VisitStates>& agents_;
  const std::vector<AgentIndex>& now_;
  const std::vector<Cell>& to_;
};

}  // namespace grove
