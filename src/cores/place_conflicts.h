// SPDX-License-Identifier: MIT
// Clauses that keep two agents from being on one place at the same time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cores/presence.h"
#include "cores/sat_solver.h"
#include "model/instance.h"

namespace grove::detail {

// Adds the clauses for vertex conflicts of all presences before a model violates them, as long as
// few agents can be on a place at a time. (Edge conflicts, and the splits of symmetry reasoning,
// are added when models have these conflicts.) One thread at a time.
class PlaceConflicts {
 public:
  // `solver` must outlive this object.
  explicit PlaceConflicts(SatSolver& solver) : solver_(solver) {}

  // `presence` of `agent` has a new literal, perhaps in place of another one.
  void add(AgentIndex agent, const Presence& presence, Literal literal);

 private:
  static constexpr std::size_t kMaxAgents = 16;  // on one place at a time

  // An agent that may rest on a place.
  struct Resting {
    AgentIndex agent;
    std::map<Time, Literal> by;  // [t]: it rests there from time t on, or from an earlier time
  };
  struct Visit {
    AgentIndex agent;
    Time time;
    Literal literal;
  };
  struct OnPlace {
    std::vector<Resting> resting;
    std::vector<Visit> visits;
  };
  using Visitors = std::vector<std::pair<AgentIndex, Literal>>;

  void add_visit(AgentIndex agent, const Presence& presence, Literal literal);
  void add_rest(AgentIndex agent, const Presence& presence, Literal literal);
  Literal rests_by(Resting& resting, Place place, Time time);

  SatSolver& solver_;
  std::unordered_map<std::uint64_t, Visitors> visitors_;  // by place and time
  std::unordered_map<Place, OnPlace> places_;
};

}  // namespace grove::detail
