// SPDX-License-Identifier: MIT
// Bounded dynamic programming: the forward Held-Karp recursion, restricted to states within a cost
// limit.
//
// *Definitions.* In a state (S, v) the agent is on stop v, and the set S of stops is left. g is the
// least cost of reaching the state through kept states. b is a proven lower bound on the cost of
// completing the sequence from the state (one_tree_relaxation.cpp; most of b depends only on S, so
// that part is computed once per set). A state is kept iff g + b <= cost_limit. The predecessors of
// a state (S, v) have the set S + v left, so one pass over the layers of equal |S| makes every g
// final. The tree for S + v gives a weaker b at no extra cost. It drops about 95 % of the dropped
// states, and no tree is built for their sets.
//
// *Invariant: every state of a sequence that costs <= cost_limit is kept.* *Proof* by induction
// along the sequence: the predecessor of the state is kept, so g is at most the cost of the
// sequence up to the state. b is at most the cost of the remainder. Hence g + b <= cost_limit.
//
// *Consequence.* At the first dropped state of a sequence, g + b is at most the cost of the
// sequence. So outside_bound(), the least g + b of all dropped states, is a lower bound on the cost
// of all sequences outside the graph, and a build with a cost limit below outside_bound() adds no
// sequence.
//
// *Ports.* If stops have several ports (cost_matrix.h), a state has one g per port. The statements
// above then hold for each port: it is kept or dropped by its own g + b.
//
// *Backward pass.* It computes the exact cost to go within the graph, which is also the exact cost
// to go over all sequences that cost less than outside_bound().
//
// *Parity.* On a grid all paths between two cells without waits and turns have the same parity, and
// so have all complete sequences, even if tasks take time. If the matrix has this property (the
// code verifies it), g + b is rounded up to that parity.
//
// *Direct legs.* Problem: in an aisle a sequence can skip any stops on the way in and visit them on
// the way out, at the same cost, so 2^n states are on optimal sequences. However, an agent that
// passes a plain stop visits it. So with direct legs (direct_legs.h) the graph holds the routes of
// such agents instead of all sequences. Definitions: after a path of a class has counted the prefix
// and the first free stop, it *counts* each other stop when it is first on the place of the stop
// (or first completes the task execution there). In this way the path realizes a sequence of the
// class (planning/sequence_stages.cpp). c(S, v, w) is the least sum of direct legs from v over
// stops outside S to w. *Claim: a path from v to w that counts no stop of S in between costs at
// least c(S, v, w).* *Proof.* All plain stops on the path between v and w are outside S. They cut
// the path into segments that pass no other plain stop, and each segment costs at least its direct
// leg. *Consequence.* With c(S, v, w) as the cost from v to w, g of a state is at most the cost of
// any path to this state. So the invariant holds for paths: every state of a path that costs <=
// cost_limit is kept, and outside_bound() is a lower bound on the cost of all paths with a state
// outside the graph. b remains a lower bound, because a direct leg costs no less than the leg of
// the matrix. Legs of the prefix, and the leg to the first free stop, can pass any stop, so they
// have the costs of the matrix. The graph is valid only for this class, because a different prefix
// reaches states that no path of this class can reach.
//
// *Passed stops.* If the caller needs only a cheapest member of one class, the graph holds the
// canonical sequences of the class (passed_stops.cpp). The invariant and outside_bound() then refer
// to canonical sequences. One of them is a cheapest member.
//
// *Pairs.* For stops in a row the relaxation is weak at states that leave gaps. So with direct legs
// b is at least the cost of visiting any two of the stops left, in the better order, and then going
// to the end. Each term of this sum is the least cost of a real part of the path: from the stop of
// the state to one of the two, from this one to the other, or from there to the end. (Therefore the
// last term must be valid even if other stops follow. A late cost to the end is valid only for the
// last leg of a sequence, so late_costs.cpp puts the plain cost into its direct legs.)
//
// *Hops.* A hop from v over a stop u is useless if the direct leg from v to every other stop costs
// no more than the route over u (DirectLegs::hops): the direct leg can then replace the hop,
// because it passes no other plain stop.
#include "sequencing/sequence_dag.h"

#include <array>
#include <bit>
#include <span>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/direct_legs.h"
#include "sequencing/one_tree_relaxation.h"
#include "sequencing/passed_stops.h"
#include "sequencing/sequence.h"

namespace grove::detail {
namespace {

constexpr std::size_t kPollInterval = 32;  // nodes; each takes a few microseconds

// Costs above a cost limit.
class DroppedCosts {
 public:
  explicit DroppedCosts(Time limit) : limit_(limit) {}

  void add(Time cost) {
    GROVE_ASSERT(cost > limit_, "only states above the cost limit are dropped");
    least_ = std::min(least_, cost);
    const auto excess = static_cast<std::size_t>(cost - limit_ - 1);
    if (excess >= kCountedExcess) return;
    if (excess >= by_excess_.size()) by_excess_.resize(excess + 1, 0);
    ++by_excess_[excess];
  }
  // The least cost; kNever if there is none.
  Time least() const { return least_; }
  // Returns the least limit, at least least(), up to which there are `count` costs; if there are
  // fewer, a limit that admits all that were counted.
  Time limit_of(std::size_t count) const {
    std::size_t admitted = 0;
    for (std::size_t excess = 0; excess < by_excess_.size(); ++excess)
      if ((admitted += by_excess_[excess]) >= count)
        return std::max(least_, limit_ + 1 + static_cast<Time>(excess));
    return std::max(least_, limit_ + static_cast<Time>(by_excess_.size()));
  }

 private:
  static constexpr std::size_t kCountedExcess = 4096;  // greater costs only count for least()

  const Time limit_;
  Time least_ = kNever;
  std::vector<std::size_t> by_excess_;  // number of costs, by cost - limit_ - 1
};

// Least costs by direct legs, from or to the ports of the visited stops of a node.
template <int kPorts>
class Walks {
 public:
  using PortCosts = std::array<Time, kPorts>;

  // `direct`: the legs; may be nullptr, and then only is_used() may be called.
  explicit Walks(const DirectLegs* direct) : direct_(direct) {}
  bool is_used() const { return direct_ != nullptr; }

  // Starts forward walks.
  void clear() {
    costs_.fill(kNever);
    reached_.clear();
  }
  // A walk starts at, or reaches, `port` at this cost.
  void reach(int port, Time cost) {
    if (cost >= costs_[port]) return;
    costs_[port] = cost;
    reached_.push_back(port);
  }
  // Continues all walks over visited stops, i.e. without visiting a stop of `left`.
  void extend(StopSet left) {
    for (std::size_t next = 0; next < reached_.size(); ++next)
      for (const int by : direct_->hops(reached_[next]))
        if ((left & bit(by / kPorts)) == 0)
          reach(by, add_costs(costs_[reached_[next]], direct_->leg(reached_[next], by)));
  }
  // The least costs of walking on to the ports of stop `next`.
  PortCosts costs_to(int next) const {
    PortCosts costs;
    costs.fill(kNever);
    for (const int from : reached_)
      for (int to = 0; to < kPorts; ++to)
        costs[to] =
            std::min(costs[to], add_costs(costs_[from], direct_->leg(from, next * kPorts + to)));
    return costs;
  }

  // Computes the costs to go from each port of the stops in `visited`, by iteration to a fixed
  // point. `onward`: the costs to go from each port of the stops in `left`.
  void compute_costs_to_go(StopSet visited, StopSet left, std::span<const Time> onward) {
    costs_.fill(kNever);
    const auto for_each_visited = [&](auto visit) {
      for_each_stop(visited, [&](int stop) {
        for (int port = stop * kPorts; port < (stop + 1) * kPorts; ++port) visit(port);
      });
    };
    for_each_visited([&](int from) {
      for_each_stop(left, [&](int next) {
        for (int to = next * kPorts; to < (next + 1) * kPorts; ++to)
          costs_[from] = std::min(costs_[from], add_costs(direct_->leg(from, to), onward[to]));
      });
    });
    for (bool changed = true; changed;) {
      changed = false;
      for_each_visited([&](int from) {
        for (const int by : direct_->hops(from)) {
          if ((left & bit(by / kPorts)) != 0) continue;
          const Time cost = add_costs(direct_->leg(from, by), costs_[by]);
          if (cost >= costs_[from]) continue;
          costs_[from] = cost;
          changed = true;
        }
      });
    }
  }
  // The costs to go from the ports of a visited stop.
  const Time* costs_from(int stop) const { return &costs_[stop * kPorts]; }

 private:
  const DirectLegs* const direct_;
  std::array<Time, kMaxTasksPerAgent * kPorts> costs_;  // by port of a visited stop
  std::vector<int> reached_;  // ports with a cost of a forward walk, possibly with duplicates
};

}  // namespace

Time SequenceDag::cost_to_go(StopSet left, int port) const {
  const std::uint32_t number = index_.find(left);
  if (number == StopSetIndex::kAbsent) return kNever;
  const Node& node = nodes_[number];
  const int stop = port / ports_;
  if ((node.at & bit(stop)) == 0) return kNever;
  const auto state = node.first + std::popcount(node.at & (bit(stop) - 1));
  return cost_to_go_[state * ports_ + port % ports_];
}

template <int kPorts>
class SequenceDagBuilder {
 public:
  SequenceDagBuilder(const SequenceDag::Scope& scope, Time cost_limit, const Limits& limits)
      : scope_(scope),
        cost_limit_(cost_limit),
        limits_(limits),
        pair_costs_(pair_costs(scope.matrix, scope.direct)),
        parity_(scope.direct == nullptr || scope.direct->keeps_parity()
                    ? common_parity(scope.matrix)
                    : -1),
        dropped_(cost_limit),
        walks_(scope.direct) {
    dag_.ports_ = kPorts;
  }

  SequenceDag::End build(SequenceDag& dag) {
    const int size_of_free = reach_first_states();
    std::size_t layer = 0;
    for (int size = size_of_free; size > 0; --size) {
      close_layer();
      const std::size_t end = dag_.nodes_.size();
      if (!expand(layer, end))
        return is_too_large() ? SequenceDag::End::kTooLarge : SequenceDag::End::kStopped;
      layer = end;
    }
    if (!compute_cost_to_go()) return SequenceDag::End::kStopped;
    dag_.outside_bound_ = dropped_.least();
    GROVE_CHECK(dag_.outside_bound_ > cost_limit_,
                "the graph holds all sequences within the cost limit");
    // The successors of the newly admitted states add about as many again.
    dag_.next_cost_limit_ = dropped_.limit_of(dag_.cost_to_go_.size() / 2);
    dag = std::move(dag_);
    return SequenceDag::End::kBuilt;
  }

 private:
  using PortCosts = std::array<Time, kPorts>;

  // A set of stops left in the layer under construction. State is a state of that layer.
  struct Group {
    SequenceDag::Node node;
    OneTreeRelaxation::Tail tail;
  };
  struct State {
    std::uint32_t group;
    PortCosts costs;
    Stop stop;
  };
  // The layer under construction.
  struct Layer {
    std::vector<Group> groups;
    std::vector<State> states;
    StopSetIndex index;  // into groups

    std::size_t bytes() const {
      return groups.capacity() * sizeof(Group) + states.capacity() * sizeof(State) + index.bytes();
    }
    void clear() {
      groups.clear();
      states.clear();
      index = {};
    }
  };

  // Adds the states in which the first free stop after the prefix has just been visited; for a
  // complete prefix, the state at its end. Returns the number of free stops.
  int reach_first_states() {
    constexpr int kStart = -1;
    int last = kStart;
    PortCosts at_last;
    at_last.fill(0);
    const auto costs_at = [&](int stop) {
      PortCosts costs;
      costs.fill(kNever);
      for (int to = 0; to < kPorts; ++to)
        for (int from = 0; from < kPorts; ++from)
          costs[to] = std::min(
              costs[to],
              add_costs(at_last[from], last == kStart ? scope_.matrix.from_start(stop * kPorts + to)
                                                      : scope_.matrix.between(last * kPorts + from,
                                                                              stop * kPorts + to)));
      return costs;
    };
    StopSet left = scope_.matrix.all();
    for (const Stop stop : scope_.sequence_class.prefix) {
      at_last = costs_at(stop);
      last = stop;
      left &= ~bit(stop);
    }
    for_each_stop(left & ~scope_.sequence_class.forbidden_next,
                  [&](int stop) { reach_state(left & ~bit(stop), stop, costs_at(stop)); });
    if (left == 0 && last != kStart) {
      reach_state(0, last, at_last);
      close_layer();
    }
    return std::popcount(left);
  }

  static Time least(const PortCosts& costs) { return *std::ranges::min_element(costs); }

  // Adds the state (left, stop), reached at `costs` by port. Drops the ports with g + b >
  // cost_limit_, and the state if no port remains.
  void reach_state(StopSet left, int stop, PortCosts costs) {
    if (least(costs) >= kNever) return;
    const std::uint32_t number =
        layer_.index.insert(left, static_cast<std::uint32_t>(layer_.groups.size()));
    if (number == layer_.groups.size()) {
      layer_.groups.push_back({{left, 0, 0}, {}});
      if (left != 0) layer_.groups.back().tail = scope_.relaxation.tail(left);
    }
    Group& group = layer_.groups[number];
    for (int i = 0; i < kPorts; ++i) {
      const int port = stop * kPorts + i;
      const Time rest =
          left == 0 ? scope_.matrix.to_end(port) : scope_.relaxation.bound(group.tail, left, port);
      const Time whole = round_up(add_costs(costs[i], rest));
      GROVE_ASSERT(left != 0 || whole == add_costs(costs[i], rest),
                   "the costs of complete sequences have a common parity");
      if (whole <= cost_limit_) continue;
      dropped_.add(whole);
      costs[i] = kNever;
    }
    if (walks_.is_used() && left != 0) drop_by_pairs(left, stop, costs);
    if (least(costs) >= kNever) return;
    GROVE_ASSERT((left & bit(stop)) == 0 && (group.node.at & bit(stop)) == 0,
                 "a state is reached once, with its own stop visited");
    group.node.at |= bit(stop);
    layer_.states.push_back({number, costs, static_cast<Stop>(stop)});
  }

  void drop_by_pairs(StopSet left, int stop, PortCosts& costs) {
    const Time rest = bound_of_pairs(left, stop);
    for (Time& cost : costs) {
      const Time whole = round_up(add_costs(cost, rest));
      if (cost >= kNever || whole <= cost_limit_) continue;
      dropped_.add(whole);
      cost = kNever;
    }
  }
  // Returns the bound of the paragraph "Pairs": the maximum, over single stops and pairs of stops
  // left, of the cost of the cheapest order.
  Time bound_of_pairs(StopSet left, int from) const {
    Time bound = 0;
    for_each_stop(left, [&](int one) {
      const Time to_one = pair_costs_.cost(from, one);
      const Time from_one = pair_costs_.cost(one, scope_.matrix.stops());
      bound = std::max(bound, add_costs(to_one, from_one));
      for_each_stop(left & ~(bit(one) | (bit(one) - 1)), [&](int two) {
        const Time one_first = add_costs(add_costs(to_one, pair_costs_.cost(one, two)),
                                         pair_costs_.cost(two, scope_.matrix.stops()));
        const Time two_first =
            add_costs(add_costs(pair_costs_.cost(from, two), pair_costs_.cost(two, one)), from_one);
        bound = std::max(bound, std::min(one_first, two_first));
      });
    });
    return bound;
  }
  // The least legs over the ports. The column to the end is that of the direct legs, which is valid
  // for any path.
  static CostMatrix pair_costs(const CostMatrix& matrix, const DirectLegs* direct) {
    if (direct == nullptr) return {};
    CostMatrix any = matrix;
    const int end = any.cost.size() - 1;
    for (int from = 0; from <= end; ++from) any.cost(from, end) = direct->matrix().cost(from, end);
    return min_matrix(any);
  }

  Time round_up(Time cost) const {
    return cost < kNever && parity_ >= 0 && (cost & 1) != parity_ ? cost + 1 : cost;
  }

  Time* costs_of(std::uint32_t state) { return &dag_.cost_to_go_[state * std::size_t{kPorts}]; }

  // Moves the groups that contain a state into the graph. Until the backward pass, cost_to_go_
  // holds the costs g of the states.
  void close_layer() {
    tails_.clear();
    auto first = static_cast<std::uint32_t>(dag_.state_count());
    dag_.cost_to_go_.resize((first + layer_.states.size()) * kPorts);
    for (Group& group : layer_.groups) {
      group.node.first = first;
      if (group.node.at == 0) continue;
      first += static_cast<std::uint32_t>(std::popcount(group.node.at));
      dag_.index_.insert(group.node.left, static_cast<std::uint32_t>(dag_.nodes_.size()));
      dag_.nodes_.push_back(group.node);
      tails_.push_back(group.tail);
    }
    GROVE_CHECK(first == dag_.state_count(), "each state of a layer is in one node");
    for (const State& state : layer_.states) {
      const SequenceDag::Node& node = layer_.groups[state.group].node;
      std::ranges::copy(state.costs,
                        costs_of(node.first + std::popcount(node.at & (bit(state.stop) - 1))));
    }
    layer_.clear();
  }

  // Expands every node of [begin, end) to every stop left. Returns false if a limit was reached or
  // the graph is too large.
  bool expand(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i % kPollInterval == 0 && !may_continue()) return false;
      const SequenceDag::Node& node = dag_.nodes_[i];
      if (walks_.is_used()) walk(node);
      for_each_stop(node.left, [&](int next) {
        const PortCosts costs =
            walks_.is_used() ? walks_.costs_to(next) : costs_of_reaching(next, node);
        // The weaker b: few states pass this test, and no tail is computed for the others.
        Time whole = kNever;
        for (int port = 0; port < kPorts; ++port)
          whole =
              std::min(whole, add_costs(costs[port], scope_.relaxation.bound_from(
                                                         tails_[i - begin], next * kPorts + port)));
        whole = round_up(whole);
        if (whole <= cost_limit_)
          reach_state(node.left & ~bit(next), next, costs);
        else
          dropped_.add(whole);
      });
    }
    return true;
  }

  StopSet visited(const SequenceDag::Node& node) const { return scope_.matrix.all() & ~node.left; }

  // Computes the least cost of reaching each port of a visited stop by direct legs from the states
  // of the node, without visiting a stop that is left.
  void walk(const SequenceDag::Node& node) {
    walks_.clear();
    std::uint32_t state = node.first;
    for_each_stop(node.at, [&](int stop) {
      const Time* here = costs_of(state++);
      for (int i = 0; i < kPorts; ++i) walks_.reach(stop * kPorts + i, here[i]);
    });
    walks_.extend(node.left);
  }

  PortCosts costs_of_reaching(int next, const SequenceDag::Node& node) {
    PortCosts costs;
    costs.fill(kNever);
    std::uint32_t state = node.first;
    for_each_stop(node.at, [&](int stop) {
      const Time* here = costs_of(state++);
      if (scope_.passed != nullptr && (scope_.passed->on_leg(stop, next) & node.left) != 0) return;
      for (int from = 0; from < kPorts; ++from)
        for (int to = 0; to < kPorts; ++to)
          costs[to] =
              std::min(costs[to], add_costs(here[from], scope_.matrix.between(stop * kPorts + from,
                                                                              next * kPorts + to)));
    });
    return costs;
  }

  // Tests the limits and the size of the graph. Any vector can double its capacity when it grows,
  // so the test requests the current memory a second time.
  bool may_continue() {
    const std::size_t bytes = dag_.nodes_.capacity() * sizeof(SequenceDag::Node) +
                              dag_.cost_to_go_.capacity() * sizeof(Time) + dag_.index_.bytes() +
                              layer_.bytes() + tails_.capacity() * sizeof(OneTreeRelaxation::Tail);
    if (bytes != asked_bytes_ && !limits_.memory_allows(bytes)) limits_.memory_exhausted();
    asked_bytes_ = bytes;
    return !is_too_large() && !limits_.stop_requested();
  }
  bool is_too_large() const {
    return dag_.state_count() + layer_.states.size() > scope_.max_states;
  }

  bool compute_cost_to_go() {
    for (std::size_t i = dag_.nodes_.size(); i-- > 0;) {
      if (i % kPollInterval == 0 && !may_continue()) return false;
      if (walks_.is_used() && dag_.nodes_[i].left != 0)
        compute_walks(dag_.nodes_[i]);
      else
        compute_cost_to_go_of(dag_.nodes_[i]);
    }
    return true;
  }

  // The cost to go from each port of the stops left, by port.
  using Onward = std::array<Time, kMaxTasksPerAgent * kPorts>;
  void set_onward(const SequenceDag::Node& node, Onward& onward) const {
    for_each_stop(node.left, [&](int next) {
      for (int port = next * kPorts; port < (next + 1) * kPorts; ++port)
        onward[port] = dag_.cost_to_go(node.left & ~bit(next), port);
    });
  }

  // The same as compute_cost_to_go_of(), by direct legs.
  void compute_walks(const SequenceDag::Node& node) {
    Onward onward;
    set_onward(node, onward);
    walks_.compute_costs_to_go(visited(node), node.left, onward);
    std::uint32_t state = node.first;
    for_each_stop(node.at, [&](int stop) {
      std::copy_n(walks_.costs_from(stop), kPorts, costs_of(state++));
    });
  }

  // Computes the costs to go of the states of a node. A dropped port also gets the cost of its
  // routes inside the graph, because these routes exist.
  void compute_cost_to_go_of(const SequenceDag::Node& node) {
    Onward onward;
    set_onward(node, onward);
    std::uint32_t state = node.first;
    for_each_stop(node.at, [&](int stop) {
      Time* here = costs_of(state++);
      for (int from = 0; from < kPorts; ++from) {
        const int port = stop * kPorts + from;
        Time best = node.left == 0 ? scope_.matrix.to_end(port) : kNever;
        for_each_stop(node.left, [&](int next) {
          for (int to = next * kPorts; to < (next + 1) * kPorts; ++to)
            best = std::min(best, add_costs(scope_.matrix.between(port, to), onward[to]));
        });
        here[from] = best;
      }
    });
  }

  const SequenceDag::Scope scope_;
  const Time cost_limit_;
  const Limits& limits_;
  const CostMatrix pair_costs_;  // by stop; empty without direct legs
  const int parity_;

  SequenceDag dag_{kNever};
  Layer layer_;
  std::vector<OneTreeRelaxation::Tail> tails_;  // by node of the last layer
  DroppedCosts dropped_;
  Walks<kPorts> walks_;
  std::size_t asked_bytes_ = 0;
};

std::optional<SequenceDag> SequenceDag::build(const CostMatrix& matrix,
                                              const OneTreeRelaxation& relaxation, Time cost_limit,
                                              const Limits& limits) {
  SequenceDag dag(0);
  if (build({matrix, relaxation}, cost_limit, limits, dag) != End::kBuilt) return std::nullopt;
  return dag;
}

SequenceDag::End SequenceDag::build(const Scope& scope, Time cost_limit, const Limits& limits,
                                    SequenceDag& dag) {
  if (scope.matrix.ports == 1) return SequenceDagBuilder<1>(scope, cost_limit, limits).build(dag);
  GROVE_ASSERT(scope.matrix.ports == 4, "a stop has one port, or one for each heading");
  return SequenceDagBuilder<4>(scope, cost_limit, limits).build(dag);
}

}  // namespace grove::detail
