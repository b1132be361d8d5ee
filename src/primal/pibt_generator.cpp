// SPDX-License-Identifier: MIT
// Priority inheritance with backtracking (PIBT: Okumura, Machida, Defago and Tamura, AIJ 2022).
//
// The agents choose their next states one after the other, by priority. An agent prefers the state
// with the least remaining distance, ties broken in favour of a place that is empty now, then at
// random. The agent that is on the chosen place must choose next, whatever its own priority, and
// must leave. If it cannot, it stays, and the first agent tries its next candidate. Each agent
// chooses once, so a joint step takes O(agents x candidates) time.
//
// If two agents can pass each other only at a junction behind one of them (swaps.cpp), that agent
// tries its candidates in reverse order, away from the other agent, and pulls the other agent
// along.
//
// LaCAM constraints are reservations made before any agent chooses.
#include "primal/pibt_generator.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {

PibtGenerator::PibtGenerator(const World& world, std::vector<VisitStages>& agents)
    : world_(world),
      agents_(agents),
      now_(world.place_count(), kNoAgent),
      later_(world.place_count(), kNoAgent),
      to_(agents.size(), kNoState),
      swaps_(world, agents, now_, to_) {}

std::span<const State> PibtGenerator::step(std::span<const AgentState> from,
                                           std::span<const AgentIndex> priority,
                                           std::span<const LacamConstraint> constraints,
                                           SplitMix64& dice) {
  from_ = from;
  dice_ = &dice;
  std::ranges::fill(to_, kNoState);
  for (std::size_t agent = 0; agent < from.size(); ++agent) {
    AgentIndex& there = now_[world_.place(from[agent].state)];
    GROVE_ASSERT(there == kNoAgent, "a place holds at most one agent");
    there = static_cast<AgentIndex>(agent);
  }
  const bool done = apply(constraints) && std::ranges::all_of(priority, [&](AgentIndex agent) {
                      return to_[agent] != kNoState || push(agent);
                    });
  GROVE_ASSERT(candidates_.empty(), "no agent is choosing after a joint step");
  if (done)
    for (std::size_t agent = 0; agent < from.size(); ++agent)
      GROVE_ASSERT(is_possible(static_cast<AgentIndex>(agent)),
                   "agents do not collide in a joint step");
  clear();
  return done ? std::span<const State>(to_) : std::span<const State>();
}

bool PibtGenerator::apply(std::span<const LacamConstraint> constraints) {
  return std::ranges::all_of(constraints, [&](const LacamConstraint& order) {
    GROVE_ASSERT(to_[order.agent] == kNoState, "an agent has at most one constraint");
    if (collides(order.agent, order.state)) return false;
    move(order.agent, order.state);
    return true;
  });
}

// Chooses the next state of an agent that has none yet. Returns false if the agent must stay.
bool PibtGenerator::push(AgentIndex agent) {
  const std::size_t first = candidates_.size();
  rank_candidates(agent);
  const bool moved = try_candidates(agent, first);
  candidates_.resize(first);
  if (!moved) move(agent, from_[agent].state);
  return moved;
}

// Tries the agent's candidates, which start at index `first`. Returns false if none is possible.
bool PibtGenerator::try_candidates(AgentIndex agent, std::size_t first) {
  const std::size_t end = candidates_.size();
  const AgentIndex partner = swaps_.partner(agent, candidates_[first].state, from_);
  if (partner != kNoAgent)
    std::reverse(candidates_.begin() + static_cast<std::ptrdiff_t>(first), candidates_.end());
  for (std::size_t i = first; i < end; ++i) {
    const State state = candidates_[i].state;
    if (collides(agent, state)) continue;
    move(agent, state);
    const AgentIndex there = now_[world_.place(state)];
    if (there != kNoAgent && to_[there] == kNoState && !push(there)) continue;
    if (partner != kNoAgent && i == first) pull(partner, from_[agent].state);
    return true;
  }
  return false;
}

// Moves an agent to the state that its neighbour leaves, unless the agent's next state is already
// chosen or another agent will be on that place.
void PibtGenerator::pull(AgentIndex agent, State state) {
  if (to_[agent] == kNoState && later_[world_.place(state)] == kNoAgent) move(agent, state);
}

// Appends the agent's candidates to candidates_, best first.
void PibtGenerator::rank_candidates(AgentIndex agent) {
  const AgentState from = from_[agent];
  VisitStages& visits = agents_[agent];
  const auto first = static_cast<std::ptrdiff_t>(candidates_.size());
  const auto add = [&](State state, bool taken) {
    const Time to_go = visits.distance(visits.after(from.stage, state), state);
    candidates_.push_back({state, std::int64_t{to_go} << 32 | std::int64_t{taken} << 31 |
                                      std::int64_t{dice_->next() >> 1}});
  };
  add(from.state, false);
  for (State state : world_.moves(from.state)) {
    if (!visits.may_enter(from.stage, state)) continue;
    const AgentIndex there = now_[world_.place(state)];
    add(state, there != kNoAgent && there != agent);
  }
  std::sort(candidates_.begin() + first, candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.key < b.key; });
}

bool PibtGenerator::collides(AgentIndex agent, State state) const {
  const Place place = world_.place(state);
  if (later_[place] != kNoAgent) return true;
  const AgentIndex there = now_[place];
  return there != kNoAgent && there != agent && to_[there] != kNoState &&
         world_.place(to_[there]) == world_.place(from_[agent].state);
}

// True if the decided move of `agent` does not collide, neither on its new place nor on the way.
bool PibtGenerator::is_possible(AgentIndex agent) const {
  if (to_[agent] == kNoState || later_[world_.place(to_[agent])] != agent) return false;
  const AgentIndex there = now_[world_.place(to_[agent])];
  return there == kNoAgent || there == agent ||
         world_.place(to_[there]) != world_.place(from_[agent].state);
}

void PibtGenerator::move(AgentIndex agent, State state) {
  to_[agent] = state;
  later_[world_.place(state)] = agent;
}

void PibtGenerator::clear() {
  for (const AgentState& from : from_) now_[world_.place(from.state)] = kNoAgent;
  for (State state : to_)
    if (state != kNoState) later_[world_.place(state)] = kNoAgent;
}

}  // namespace grove::detail
