// SPDX-License-Identifier: MIT
// Priority inheritance with backtracking (PIBT: Okumura, Machida, Defago and Tamura, AIJ 2022).
//
// Agents choose a next cell one after the other by priority: the one from which the rest of their
// way is shortest, then one that is empty now, then by dice. Who stands on the cell chosen must
// choose next, whatever its own priority, and must find a cell; if it cannot, it stays and the
// first one tries its next choice. Each agent decides once, so a step takes about agents x
// candidates time.
//
// Two agents that can pass each other only at a junction behind them (swaps.cpp): the one that
// chooses takes its candidates in reverse, away from the other, and pulls it along.
//
// Orders (LaCAM's constraints) are reservations made before anybody chooses.
#include "configuration_generator.h"

#include <algorithm>

namespace grove {

ConfigurationGenerator::ConfigurationGenerator(const Grid& grid, std::vector<VisitStates>& agents)
    : grid_(grid),
      agents_(agents),
      now_(grid.cell_count(), kNobody),
      later_(grid.cell_count(), kNobody),
      to_(agents.size(), kNoCell),
      swaps_(grid, agents, now_, to_) {}

std::span<const Cell> ConfigurationGenerator::step(std::span<const Place> from,
                                                   std::span<const AgentIndex> priority,
                                                   std::span<const Order> orders, Dice& dice) {
  from_ = from;
  dice_ = &dice;
  std::ranges::fill(to_, kNoCell);
  for (std::size_t agent = 0; agent < from.size(); ++agent)
    now_[from[agent].cell] = static_cast<AgentIndex>(agent);
  const bool done = obey(orders) && std::ranges::all_of(priority, [&](AgentIndex agent) {
                      return to_[agent] != kNoCell || push(agent);
                    });
  clear();
  return done ? std::span<const Cell>(to_) : std::span<const Cell>();
}

bool ConfigurationGenerator::obey(std::span<const Order> orders) {
  return std::ranges::all_of(orders, [&](const Order& order) {
    if (collides(order.agent, order.cell)) return false;
    move(order.agent, order.cell);
    return true;
  });
}

// Finds a cell for an agent that has none yet.
bool ConfigurationGenerator::push(AgentIndex agent) {
  Candidates candidates;
  const std::size_t count = rank_candidates(agent, candidates);
  const AgentIndex partner = swaps_.partner(agent, candidates[0].cell, from_);
  if (partner != kNobody) std::reverse(candidates.begin(), candidates.begin() + count);
  for (std::size_t i = 0; i < count; ++i) {
    const Cell cell = candidates[i].cell;
    if (collides(agent, cell)) continue;
    move(agent, cell);
    const AgentIndex there = now_[cell];
    if (there != kNobody && to_[there] == kNoCell && !push(there)) continue;
    if (partner != kNobody && i == 0) pull(partner, from_[agent].cell);
    return true;
  }
  move(agent, from_[agent].cell);
  return false;
}

// Brings an agent along to a cell that its neighbour has left, if both are free to.
void ConfigurationGenerator::pull(AgentIndex agent, Cell cell) {
  if (to_[agent] == kNoCell && later_[cell] == kNobody) move(agent, cell);
}

std::size_t ConfigurationGenerator::rank_candidates(AgentIndex agent, Candidates& candidates) {
  const Place from = from_[agent];
  VisitStates& visits = agents_[agent];
  std::size_t count = 0;
  const auto add = [&](Cell cell, bool taken) {
    const Time to_go = visits.distance(visits.after(from.state, cell), cell);
    candidates[count++] = {cell, std::int64_t{to_go} << 32 | std::int64_t{taken} << 31 |
                                     std::int64_t{dice_->next() >> 1}};
  };
  add(from.cell, false);
  for (Cell cell : grid_.neighbors(from.cell)) add(cell, now_[cell] != kNobody);
  std::sort(candidates.begin(), candidates.begin() + count,
            [](const Candidate& a, const Candidate& b) { return a.key < b.key; });
  return count;
}

bool ConfigurationGenerator::collides(AgentIndex agent, Cell cell) const {
  if (later_[cell] != kNobody) return true;
  const AgentIndex there = now_[cell];
  return there != kNobody && there != agent && to_[there] == from_[agent].cell;
}

void ConfigurationGenerator::move(AgentIndex agent, Cell cell) {
  to_[agent] = cell;
  later_[cell] = agent;
}

void ConfigurationGenerator::clear() {
  for (const Place& place : from_) now_[place.cell] = kNobody;
  for (Cell cell : to_)
    if (cell != kNoCell) later_[cell] = kNobody;
}

}  // namespace grove
