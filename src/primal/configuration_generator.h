// SPDX-License-Identifier: MIT
// One joint step of all agents.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "configurations.h"
#include "dice.h"
#include "swaps.h"

namespace grove {

// Where an agent is told to be after the step.
struct Order {
  AgentIndex agent;
  Cell cell;
};

// Makes joint steps by priority inheritance with backtracking (PIBT). Workspace of one thread.
class ConfigurationGenerator {
 public:
  // `grid` and `agents` must outlive this.
  ConfigurationGenerator(const Grid& grid, std::vector<VisitStates>& agents);

  // A step from `from` without collisions in which every order is obeyed; agents come earlier in
  // `priority` the more they matter. The result, by agent, holds until the next call; empty if none
  // was found, which is certain only if every agent has an order.
  std::span<const Cell> step(std::span<const Place> from, std::span<const AgentIndex> priority,
                             std::span<const Order> orders, Dice& dice);

 private:
  static constexpr AgentIndex kNobody = Swaps::kNobody;

  struct Candidate {
    Cell cell;
    std::int64_t key;
  };
  using Candidates = std::array<Candidate, 5>;

  bool obey(std::span<const Order> orders);
  bool push(AgentIndex agent);
  void pull(AgentIndex agent, Cell cell);
  std::size_t rank_candidates(AgentIndex agent, Candidates& candidates);
  bool collides(AgentIndex agent, Cell cell) const;
  void move(AgentIndex agent, Cell cell);
  void clear();

  const Grid& grid_;
  std::vector<VisitStates>& agents_;
  std::vector<AgentIndex> now_;    // by cell: who is there
  std::vector<AgentIndex> later_;  // by cell: who will be there
  std::vector<Cell> to_;           // by agent; kNoCell: not decided
  Swaps swaps_;
  std::span<const Place> from_;
  Dice* dice_ = nullptr;
};

}  // namespace grove
