// SPDX-License-Identifier: MIT
// Direct legs by breadth-first search.
//
// One search runs from each port over the world of the agent. It enters states on the place of a
// plain stop but leaves them only if it started on this stop. A leg leaves a stop in a base state
// on it: in the heading of the port or, if stops have one port, in any heading. So the search
// covers every path from i to j that passes no other plain stop, and the length of the path is at
// least the depth of j. (The search also covers executions of tasks of other agents, which only
// makes depths smaller.)
//
// An agent that starts on a plain stop visits this stop at time 0, so all its other legs from the
// start are kNever.
#include "sequencing/direct_legs.h"

#include <algorithm>

#include "model/assert.h"
#include "sequencing/sequence.h"

namespace grove::detail {
namespace {

class DirectLegSearch {
 public:
  DirectLegSearch(const Instance& instance, AgentIndex agent, const CostMatrix& matrix)
      : instance_(instance),
        world_(instance.world()),
        who_(instance.agent(agent)),
        direct_(matrix),
        plain_at_(static_cast<std::size_t>(world_.place_count()), kNone) {
    for (int stop = 0; stop < direct_.stops(); ++stop)
      if (task(stop).duration == 0) plain_at_[task(stop).cell] = stop;
  }

  CostMatrix run() {
    const int ports = direct_.stops() * direct_.ports;
    for (int port = 0; port < ports; ++port) {
      const int stop = port / direct_.ports;
      const StateRange bases = world_.bases(task(stop).cell, who_.kind);
      begin(plain_at_[task(stop).cell]);
      if (direct_.ports > 1)
        enter(bases.first + port % direct_.ports, 0);
      else
        for (State state = bases.first; state < bases.end; ++state) enter(state, 0);
      raise_row(port, stop);
    }
    begin(kNone);
    enter(who_.start, 0);
    raise_row(ports, kNone);
    return std::move(direct_);
  }

 private:
  static constexpr int kNone = -1;

  const Task& task(int stop) const { return instance_.task(who_.stops[stop]); }

  void begin(int from) {
    from_ = from;
    depth_.assign(static_cast<std::size_t>(world_.state_count()), kNever);
    queue_.clear();
  }
  void enter(State state, Time depth) {
    if (depth_[state] < kNever) return;
    depth_[state] = depth;
    queue_.push_back(state);
  }

  void raise_row(int row, int stop) {
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const State state = queue_[next];
      const int at = plain_at_[world_.place(state)];
      if (at != kNone && at != from_) continue;
      for (const State to : world_.moves(state)) enter(to, depth_[state] + 1);
    }
    for (int to = 0; to < direct_.stops(); ++to) {
      if (to == stop) continue;
      for (int i = 0; i < direct_.ports; ++i) raise(row, to, i);
    }
  }

  void raise(int row, int to, int heading) {
    Time depth = kNever;
    const StateRange bases = world_.bases(task(to).cell, who_.kind);
    for (const State state : instance_.states_visiting(who_.stops[to]))
      if (direct_.ports == 1 || world_.base(state) == bases.first + heading)
        depth = std::min(depth, depth_[state]);
    Time& cost = direct_.cost(row, to * direct_.ports + heading);
    cost = std::max(cost, depth);
  }

  const Instance& instance_;
  const World& world_;
  const Agent& who_;
  CostMatrix direct_;
  std::vector<int> plain_at_;  // by place: the plain stop there
  int from_ = kNone;
  std::vector<Time> depth_;  // by state
  std::vector<State> queue_;
};

}  // namespace

CostMatrix direct_legs(const Instance& instance, AgentIndex agent, const CostMatrix& matrix) {
  return DirectLegSearch(instance, agent, matrix).run();
}

DirectLegs::DirectLegs(CostMatrix direct, const CostMatrix& matrix)
    : direct_(std::move(direct)), hops_(static_cast<std::size_t>(matrix.stops() * matrix.ports)) {
  const int ports = matrix.stops() * matrix.ports;
  for (int from = 0; from <= ports; ++from)
    for (int to = 0; to < ports; ++to) {
      GROVE_ASSERT(leg(from, to) >= matrix.between(from, to),
                   "a direct leg costs no less than a leg");
      if (leg(from, to) < kNever && (leg(from, to) ^ matrix.between(from, to)) & 1)
        keeps_parity_ = false;
    }
  for (int from = 0; from < ports; ++from)
    for (int by = 0; by < ports; ++by) {
      if (by == from || leg(from, by) >= kNever) continue;
      const auto is_nearer = [&](int to) {
        return to / matrix.ports != by / matrix.ports &&
               add_costs(leg(from, by), matrix.between(by, to)) < leg(from, to);
      };
      for (int to = 0; to < ports; ++to)
        if (to / matrix.ports != from / matrix.ports && is_nearer(to)) {
          hops_[static_cast<std::size_t>(from)].push_back(by);
          break;
        }
    }
}

}  // namespace grove::detail
