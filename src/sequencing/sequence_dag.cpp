// SPDX-License-Identifier: MIT
// Bounded dynamic programming: the Held-Karp recursion, forward, over the states that matter.
//
// A state (S, v) - at stop v with the set S left - is kept iff g + b <= reach, where g is the least
// cost of getting there through states kept and b a proven bound on completing
// (path_relaxation.cpp; most of it depends on S alone, so it is paid once per set). All states with
// the same S have as their predecessors only states with S + v left, so one pass over the layers of
// equal size settles every g. A weaker b comes for nothing from the tree of S + v: some
// 95 % of the states dropped are dropped for that, and no tree is made for their sets.
//
// Invariant: every state of a sequence that costs <= reach is kept. By induction along the
// sequence: its state's predecessor is kept, so g is at most the cost of the sequence up to here; b
// is at most the cost of its remainder; so g + b <= reach. Hence a sequence with a state that was
// dropped has, at the first such state, g + b no greater than its own cost: the least g + b ever
// dropped, beyond(), bounds all sequences outside the graph from below - and no reach below it adds
// any.
//
// Where stops have several ports (cost_matrix.h), a state has a g for each, and what is said of
// states is said of their ports: each is kept or dropped by its own g + b.
//
// The backward pass then computes the exact cost to go within the graph. For a sequence below
// beyond() that is its exact cost to go.
//
// On a grid all ways between two cells have the same parity, so all complete sequences have the
// same one too, and so they have with work that takes time. Where the matrix shows that (verified,
// not assumed), g + b is rounded up to that parity.
#include "grove/detail/sequencing/sequence_dag.h"

#include <array>
#include <bit>

#include "grove/detail/model/assert.h"
#include "grove/detail/sequencing/cost_matrix.h"
#include "path_relaxation.h"
#include "stop_set.h"

namespace grove::detail {
namespace {

constexpr std::size_t kPollInterval = 32;     // sets; each takes a few microseconds
constexpr std::size_t kCountedExcess = 4096;  // costs this far above the reach are not counted

// The parity of every complete sequence, or -1 when they need not share one. They do if the parity
// of each leg is a sum of one number of where it begins and one of where it ends: each stop is
// entered once and left once.
int common_parity(const CostMatrix& matrix) {
  if (matrix.ports > 1) return -1;
  const int n = matrix.stops();
  const auto odd = [&](int row, int column) { return matrix.cost(row, column) & 1; };
  const auto sum = [&](int from, int to) { return odd(from, n) ^ odd(n, to); };
  const int more = n > 1 ? odd(0, 1) ^ sum(0, 1) : 0;  // of each leg between stops
  int parity = (n - 1) * more & 1;
  for (int stop = 0; stop < n; ++stop) {
    parity ^= sum(stop, stop);
    for (int to = 0; to < n; ++to)
      if (to != stop && odd(stop, to) != (sum(stop, to) ^ more)) return -1;
  }
  return parity;
}

}  // namespace

std::size_t StopSetIndex::slot_of(StopSet set) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = (set * 0x9E3779B97F4A7C15u) >> (65 - std::bit_width(slots_.size()));
  while (slots_[slot].number != kAbsent && slots_[slot].set != set) slot = (slot + 1) & mask;
  return slot;
}

std::uint32_t StopSetIndex::insert(StopSet set, std::uint32_t number) {
  Slot& slot = slots_[slot_of(set)];
  if (slot.number != kAbsent) return slot.number;
  slot = {set, number};
  if (2 * ++used_ > slots_.size()) grow();
  return number;
}

void StopSetIndex::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.number != kAbsent) slots_[slot_of(slot.set)] = slot;
}

Time SequenceDag::completion(StopSet left, int port) const {
  const std::uint32_t number = index_.find(left);
  if (number == StopSetIndex::kAbsent) return kNever;
  const Node& node = nodes_[number];
  const int stop = port / ports_;
  if ((node.at & bit(stop)) == 0) return kNever;
  const auto state = node.first + std::popcount(node.at & (bit(stop) - 1));
  return completions_[state * ports_ + port % ports_];
}

template <int kPorts>
class SequenceDagBuilder {
 public:
  SequenceDagBuilder(const CostMatrix& matrix, const PathRelaxation& relaxation, Time reach,
                     const Limits& limits)
      : matrix_(matrix),
        relaxation_(relaxation),
        reach_(reach),
        limits_(limits),
        parity_(common_parity(matrix)) {
    dag_.ports_ = kPorts;
  }

  std::optional<SequenceDag> build() {
    const StopSet all = matrix_.all();
    for_each_stop(all, [&](int stop) {
      PortCosts costs;
      for (int port = 0; port < kPorts; ++port)
        costs[port] = matrix_.from_start(stop * kPorts + port);
      reach_state(all & ~bit(stop), stop, costs);
    });
    std::size_t layer = 0;
    for (int size = matrix_.stops(); size > 0; --size) {
      close_layer();
      const std::size_t end = dag_.nodes_.size();
      if (!expand(layer, end)) return std::nullopt;
      layer = end;
    }
    if (!settle_completions()) return std::nullopt;
    dag_.next_reach_ = next_reach();
    return std::move(dag_);
  }

 private:
  using PortCosts = std::array<Time, kPorts>;

  // A set of the layer that is being reached, and a state in it.
  struct Group {
    SequenceDag::Node node;
    PathRelaxation::Tail tail;
  };
  struct State {
    std::uint32_t group;
    PortCosts costs;
    Stop stop;
  };

  static Time least(const PortCosts& costs) { return *std::ranges::min_element(costs); }

  // Keeps the state (left, stop), reached at these costs, if it lies on a way within reach; of its
  // ports those that do.
  void reach_state(StopSet left, int stop, PortCosts costs) {
    if (least(costs) >= kNever) return;
    const std::uint32_t number =
        group_index_.insert(left, static_cast<std::uint32_t>(groups_.size()));
    if (number == groups_.size()) {
      groups_.push_back({{left, 0, 0}, {}});
      if (left != 0) groups_.back().tail = relaxation_.tail(left);
    }
    Group& group = groups_[number];
    for (int i = 0; i < kPorts; ++i) {
      const int port = stop * kPorts + i;
      const Time rest =
          left == 0 ? matrix_.to_end(port) : relaxation_.bound(group.tail, left, port);
      const Time whole = round_up(add_costs(costs[i], rest));
      if (whole <= reach_) continue;
      drop(whole);
      costs[i] = kNever;
    }
    if (least(costs) >= kNever) return;
    group.node.at |= bit(stop);
    states_.push_back({number, costs, static_cast<Stop>(stop)});
  }

  void drop(Time whole) {
    dag_.beyond_ = std::min(dag_.beyond_, whole);
    const auto excess = static_cast<std::size_t>(whole - reach_ - 1);
    if (excess >= kCountedExcess) return;
    if (excess >= dropped_.size()) dropped_.resize(excess + 1, 0);
    ++dropped_[excess];
  }

  // Where the states dropped would be half as many as those kept: what follows on them comes too.
  Time next_reach() const {
    std::size_t count = 0;
    for (std::size_t excess = 0; excess < dropped_.size(); ++excess)
      if ((count += dropped_[excess]) >= dag_.completions_.size() / 2)
        return std::max(dag_.beyond_, reach_ + 1 + static_cast<Time>(excess));
    return std::max(dag_.beyond_, reach_ + static_cast<Time>(dropped_.size()));
  }

  Time round_up(Time cost) const {
    return cost < kNever && parity_ >= 0 && (cost & 1) != parity_ ? cost + 1 : cost;
  }

  Time* costs_of(std::uint32_t state) { return &dag_.completions_[state * std::size_t{kPorts}]; }

  // Moves the groups that hold a state into the graph. Until the backward pass, "completions" are
  // the costs of getting there.
  void close_layer() {
    tails_.clear();
    auto first = static_cast<std::uint32_t>(dag_.state_count());
    dag_.completions_.resize((first + states_.size()) * kPorts);
    for (Group& group : groups_) {
      group.node.first = first;
      if (group.node.at == 0) continue;
      first += static_cast<std::uint32_t>(std::popcount(group.node.at));
      dag_.index_.insert(group.node.left, static_cast<std::uint32_t>(dag_.nodes_.size()));
      dag_.nodes_.push_back(group.node);
      tails_.push_back(group.tail);
    }
    for (const State& state : states_) {
      const SequenceDag::Node& node = groups_[state.group].node;
      std::ranges::copy(state.costs,
                        costs_of(node.first + std::popcount(node.at & (bit(state.stop) - 1))));
    }
    groups_.clear();
    states_.clear();
    group_index_ = {};
  }

  // From every node of [begin, end) to every stop left. False when a limit struck.
  bool expand(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i % kPollInterval == 0 && !may_go_on()) return false;
      const SequenceDag::Node& node = dag_.nodes_[i];
      for_each_stop(node.left, [&](int next) {
        const PortCosts costs = costs_of_reaching(next, node);
        // Few pass: spares the others a tail of their own.
        Time whole = kNever;
        for (int port = 0; port < kPorts; ++port)
          whole = std::min(
              whole, add_costs(costs[port],
                               relaxation_.bound_from(tails_[i - begin], next * kPorts + port)));
        whole = round_up(whole);
        if (whole <= reach_)
          reach_state(node.left & ~bit(next), next, costs);
        else
          drop(whole);
      });
    }
    return true;
  }

  PortCosts costs_of_reaching(int next, const SequenceDag::Node& node) {
    PortCosts costs;
    costs.fill(kNever);
    std::uint32_t state = node.first;
    for_each_stop(node.at, [&](int stop) {
      const Time* here = costs_of(state++);
      for (int from = 0; from < kPorts; ++from)
        for (int to = 0; to < kPorts; ++to)
          costs[to] = std::min(
              costs[to],
              add_costs(here[from], matrix_.between(stop * kPorts + from, next * kPorts + to)));
    });
    return costs;
  }

  // Whatever grows next may double: asks for that much before it happens.
  bool may_go_on() {
    const std::size_t bytes = dag_.nodes_.capacity() * sizeof(SequenceDag::Node) +
                              dag_.completions_.capacity() * sizeof(Time) + dag_.index_.bytes() +
                              groups_.capacity() * sizeof(Group) +
                              tails_.capacity() * sizeof(PathRelaxation::Tail) +
                              states_.capacity() * sizeof(State) + group_index_.bytes();
    if (bytes != asked_bytes_ && !limits_.memory_allows(bytes)) limits_.memory_exhausted();
    asked_bytes_ = bytes;
    return !limits_.stop_requested();
  }

  bool settle_completions() {
    for (std::size_t i = dag_.nodes_.size(); i-- > 0;) {
      if (i % kPollInterval == 0 && !may_go_on()) return false;
      settle(dag_.nodes_[i]);
    }
    return true;
  }

  // Ports that were dropped get the cost of their ways inside the graph too: those are real ways.
  void settle(const SequenceDag::Node& node) {
    Time onward[kMaxTasksPerAgent * kPorts];
    for_each_stop(node.left, [&](int next) {
      for (int port = next * kPorts; port < (next + 1) * kPorts; ++port)
        onward[port] = dag_.completion(node.left & ~bit(next), port);
    });
    std::uint32_t state = node.first;
    for_each_stop(node.at, [&](int stop) {
      Time* here = costs_of(state++);
      for (int from = 0; from < kPorts; ++from) {
        const int port = stop * kPorts + from;
        Time best = node.left == 0 ? matrix_.to_end(port) : kNever;
        for_each_stop(node.left, [&](int next) {
          for (int to = next * kPorts; to < (next + 1) * kPorts; ++to)
            best = std::min(best, add_costs(matrix_.between(port, to), onward[to]));
        });
        here[from] = best;
      }
    });
  }

  const CostMatrix& matrix_;
  const PathRelaxation& relaxation_;
  const Time reach_;
  const Limits& limits_;
  const int parity_;

  SequenceDag dag_{kNever};
  std::vector<Group> groups_;
  std::vector<PathRelaxation::Tail> tails_;  // of the last layer's nodes
  std::vector<State> states_;
  std::vector<std::size_t> dropped_;  // by how much they exceed the reach, less 1
  StopSetIndex group_index_;
  std::size_t asked_bytes_ = 0;
};

std::optional<SequenceDag> SequenceDag::build(const CostMatrix& matrix,
                                              const PathRelaxation& relaxation, Time reach,
                                              const Limits& limits) {
  if (matrix.ports == 1) return SequenceDagBuilder<1>(matrix, relaxation, reach, limits).build();
  GROVE_ASSERT(matrix.ports == 4, "a stop has one port, or one for each heading");
  return SequenceDagBuilder<4>(matrix, relaxation, reach, limits).build();
}

}  // namespace grove::detail
