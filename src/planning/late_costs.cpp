// SPDX-License-Identifier: MIT
// Problem: target reasoning and constraints without end bar places forever from some time on.
// Distances on the bare map ignore that, so a search that uses them tries every order whose cost is
// below that of the detour. Method: legs that provably begin late are charged for the detour.
//
// *Claim: a leg that leaves stop i at time e or later takes at least depth(j) steps to reach j.*
// Here depth is the depth in a breadth-first search from all base states on i that enters a place c
// only if e + depth(c) <= last(c), the last time at which an agent may be on c. *Proof.* Let c_0 =
// i, c_1, ... be the places of the leg, one per time step, begun at t >= e. depth(c_k) <= k by
// induction: the agent is on c_k at t + k, so e + depth(c_{k-1}) + 1 <= e + k <= t + k <=
// last(c_k), and the search enters c_k by depth k.
//
// *Earliest start of a leg.* No path counts stop i before dist(start, i). Consider a path that
// realizes a sequence s with i as its last stop. Until it counts i, the path visits all stops of s,
// which takes at least cost(s) - to_end(i) steps. Since cost(s) >= min_cost, the leg from i to
// the end begins at min_cost - to_end(i) or later. The costs cost(s) and to_end(i) are costs
// without constraints.
//
// *Consequence.* Each leg of a path costs at least its entry, no matter which legs precede and
// follow. So this matrix can replace the plain one: it gives lower bounds for whole sequences and
// for the remainder of a sequence from any state.
#include "planning/late_costs.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "sequencing/cost_matrix.h"
#include "sequencing/direct_legs.h"

namespace grove::detail {
namespace {

class LateCosts {
 public:
  LateCosts(const World& world, SafeIntervals& intervals, const AgentStops& stops)
      : world_(world), stops_(stops), matrix_(stops.cost_to_go().matrix()) {
    last_.resize(static_cast<std::size_t>(world.place_count()), kNever);
    for (Place place = 0; place < world.place_count(); ++place) {
      intervals.ensure_intervals(place);
      last_[place] = intervals.last_time(place);
      if (last_[place] == kNever) continue;
      world.for_each_state(place, [this](State state) { barred_.push_back(state); });
    }
  }

  std::optional<CostMatrix> raise(Time min_cost) {
    if (barred_.empty()) return std::nullopt;
    const int n = stops_.count();
    for (int stop = 0; stop < n; ++stop) {
      const Time begin = stops_.distance(stops_.start(), stop);
      raise_row(stop, begin);
      if (stops_.destination()) raise_last_leg(stop, std::max(begin, min_cost - longest_end(stop)));
    }
    raise_row(n, 0);
    return raised_ ? std::optional(std::move(matrix_)) : std::nullopt;
  }

 private:
  // Raises the legs from a stop, or from the start, to the other stops.
  void raise_row(int row, Time begin) {
    if (row < stops_.count() && !is_late(row, begin)) return;
    walk_from(row, begin);
    for (int stop = 0; stop < stops_.count(); ++stop)
      if (stop != row)
        for (int port = 0; port < stops_.ports(); ++port)
          raise_to(row, stop * stops_.ports() + port, stops_.place(stop), [&](State state) {
            return stops_.stop_at(state) == stop && is_port(state, port);
          });
  }
  bool is_port(State state, int port) const {
    if (stops_.ports() == 1) return true;
    const State first = world_.bases(world_.place(state), world_.kind(stops_.start())).first;
    return world_.base(state) == first + port;
  }
  // Maximum of to_end() over the ports of a stop.
  Time longest_end(int stop) const {
    Time longest = 0;
    for (int port = 0; port < stops_.ports(); ++port)
      longest = std::max(longest, matrix_.to_end(stop * stops_.ports() + port));
    return longest;
  }

  void raise_last_leg(int stop, Time begin) {
    if (!is_late(stop, begin)) return;
    walk_from(stop, begin);
    raise_to(stop, stops_.count() * stops_.ports(), *stops_.destination(),
             [&](State state) { return stops_.to_rest(state) == 0; });
  }

  // Raises the entries of `row` in `column` to the depth of the nearest state on `place` that
  // satisfies counts().
  template <class Counts>
  void raise_to(int row, int column, Place place, Counts counts) {
    Time depth = kNever;
    world_.for_each_state(place, [&](State state) {
      if (counts(state)) depth = std::min(depth, depth_[state]);
    });
    const bool from_start = row == stops_.count();
    const int first = row * stops_.ports();
    for (int from = first; from < first + (from_start ? 1 : stops_.ports()); ++from) {
      Time& cost = matrix_.cost(from, column);
      if (depth <= cost) continue;
      cost = depth;
      raised_ = true;
    }
  }

  // Quick test: can a leg that begins at `begin` on the stop reach some place only after the last
  // time at which an agent may be there? It uses distances to the stop in place of distances from
  // it. If the two differ, the test may miss a leg, whose entry then remains the plain one.
  bool is_late(int stop, Time begin) const {
    return std::ranges::any_of(barred_, [&](State state) {
      const Time there = stops_.distance(state, stop);
      return there < kNever && begin + there > last_[world_.place(state)];
    });
  }

  // Computes the depth of each state from the stop, or the start, of a row of the matrix; kNever
  // for unreachable states. The agent can leave a stop in any base state on it.
  void walk_from(int row, Time begin) {
    depth_.assign(static_cast<std::size_t>(world_.state_count()), kNever);
    queue_.clear();
    const State start = stops_.start();
    if (row == stops_.count()) {
      queue_.push_back(start);
    } else {
      const StateRange bases = world_.bases(stops_.place(row), world_.kind(start));
      for (State state = bases.first; state < bases.end; ++state) queue_.push_back(state);
    }
    for (const State state : queue_) depth_[state] = 0;
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const Time depth = depth_[queue_[next]] + 1;
      for (State state : world_.moves(queue_[next]))
        if (depth < depth_[state] && begin + depth <= last_[world_.place(state)]) {
          depth_[state] = depth;
          queue_.push_back(state);
        }
    }
  }

  const World& world_;
  const AgentStops& stops_;
  CostMatrix matrix_;
  bool raised_ = false;
  std::vector<Time> last_;  // by place
  std::vector<State> barred_;
  std::vector<Time> depth_;  // by state
  std::vector<State> queue_;
};

}  // namespace

std::optional<CostMatrix> late_cost_matrix(const World& world, SafeIntervals& intervals,
                                           const AgentStops& stops, Time min_cost) {
  return LateCosts(world, intervals, stops).raise(min_cost);
}

namespace {

// Returns a lower bound on the cost of every sequence of the class, computed from `goals`.
Time min_cost(SequenceStages& goals) {
  const Time outside_bound = goals.cost_to_go().outside_bound();
  const SequenceStages::StageId stage = goals.first_stage();
  if (stage == SequenceStages::kOutside) return outside_bound;
  return std::min(outside_bound, goals.distance(stage, goals.stops().start()));
}

// Returns costs to go over the late matrix. Direct legs cost at least as much as late legs. Their
// column to the end is that of the plain matrix, because a late entry in that column is valid only
// for the last leg of a sequence (sequence_dag.cpp, Pairs).
CostToGo late_costs_to_go(const AgentStops& stops, CostMatrix late) {
  const auto make_direct = [&instance = stops.instance(), agent = stops.agent(), late,
                            plain = stops.cost_to_go().matrix()] {
    CostMatrix direct = direct_legs(instance, agent, late);
    const int end = direct.cost.size() - 1;
    for (int from = 0; from <= end; ++from) direct.cost(from, end) = plain.cost(from, end);
    return direct;
  };
  return CostToGo(std::move(late), {}, make_direct);
}

}  // namespace

SequenceStages* LateStages::with_late_costs(SequenceStages& plain, const Limits& limits) {
  const Time plain_cost = min_cost(plain);
  auto matrix = late_cost_matrix(world_, intervals_, plain.stops(), plain_cost);
  if (!matrix) return nullptr;
  goals_.reset();
  const bool known = cost_to_go_ && agent_ == plain.stops().agent() &&
                     class_ == plain.sequence_class() && cost_to_go_->matrix().cost == matrix->cost;
  if (!known) {  // else the costs to go of an earlier call are reused
    agent_ = plain.stops().agent();
    class_ = plain.sequence_class();
    cost_to_go_ = late_costs_to_go(plain.stops(), std::move(*matrix));
    if (auto of_class = cost_to_go_->of_class(class_)) cost_to_go_ = std::move(of_class);
  }
  cost_to_go_->reset();
  goals_.emplace(plain.stops(), plain.sequence_class(), *cost_to_go_);
  while (cost_to_go_->outside_bound() <= plain_cost &&
         min_cost(*goals_) >= cost_to_go_->outside_bound())
    if (!cost_to_go_->extend(cost_to_go_->outside_bound(), limits)) break;
  return min_cost(*goals_) > plain_cost ? &*goals_ : nullptr;
}

}  // namespace grove::detail
