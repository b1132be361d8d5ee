// SPDX-License-Identifier: MIT
// The states are found forward, by descending number of stops left. A state at stop u with the
// stops `left` is dropped if the least price up to it plus a lower bound on the price from u to the
// end exceeds the limit. *Claim: all states of a sequence of a price <= limit are kept.* *Proof.*
// The price up to a state of the sequence plus the bound is at most the price of the sequence.
//
// *Completion bound.* A completion from u visits some stops of `left`, goes to the end, and pays
// for the stops that it leaves out. Reversed, it is a walk from the end to u that visits only stops
// of `left`, and all of `left` that the agent must visit, with the price of a stop as its prize. So
// its price is at least the price of leaving out all of `left`, plus the least reduced cost of a
// reverse label at u whose remembered visits are in `left`. For stops that the agent must visit the
// prize is 0. A few of them are always remembered, and the label must have visited those of `left`.
#include "sequencing/optional_stops_dag.h"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

#include "model/assert.h"
#include "sequencing/ng_walks.h"

namespace grove::detail {
namespace {

constexpr int kMaxRequired = 8;
// States of a layer, before duplicates are removed.
constexpr std::size_t kMaxReached = 8 * OptionalStopsDag::kMaxStates;
constexpr int kNeighbors = 6;  // at first
constexpr int kMaxNeighbors = 10;
constexpr std::int64_t kMaxEffort = 20'000'000;  // of the reverse walks, about 0.2 s

bool must_visit(const std::vector<Time>& skip, int stop) {
  return skip[static_cast<std::size_t>(stop)] >= kNever;
}

// The reverse walks, and the stops of the matrix in their order.
struct ReverseWalks {
  NgStops stops;
  std::vector<int> order;
  std::vector<std::int64_t> prizes;
};

ReverseWalks reverse_walks(const CostMatrix& matrix, const std::vector<Time>& skip,
                           const std::vector<StopSet>& neighborhoods) {
  ReverseWalks walks;
  for (int stop = 0; stop < matrix.stops(); ++stop) walks.order.push_back(stop);
  std::ranges::stable_partition(walks.order, [&](int stop) { return must_visit(skip, stop); });
  const auto required = std::ranges::count(skip, kNever);
  walks.stops.remembered = std::min(kMaxRequired, static_cast<int>(required));
  walks.stops.neighbors =
      std::min({kMaxNeighbors, NgStops::kMaxBits - walks.stops.remembered, matrix.stops()});
  walks.stops.stops.resize(walks.order.size());
  for (std::int32_t at = 0; at < std::ssize(walks.order); ++at) {
    const int stop = walks.order[at];
    walks.prizes.push_back(must_visit(skip, stop) ? 0 : skip[static_cast<std::size_t>(stop)]);
    NgStops::Stop& made = walks.stops.stops[at];
    if (matrix.to_end(stop) < kNever) made.first = matrix.to_end(stop);
    const auto rank = [&](int other) {  // the stop itself, then its neighbourhood, then the others
      if (other == stop) return 0;
      return !neighborhoods.empty() && (neighborhoods[stop] & bit(other)) != 0 ? 1 : 2;
    };
    std::vector<std::tuple<int, Time, std::int32_t>> nearest;
    for (std::int32_t to = 0; to < std::ssize(walks.order); ++to) {
      const Time leg = matrix.between(walks.order[to], stop);
      nearest.emplace_back(rank(walks.order[to]), leg, to);
      if (to != at && leg < kNever) made.legs.push_back({to, leg, 0});
    }
    std::ranges::sort(nearest);
    for (const auto& [kind, leg, to] : nearest) {
      const auto count = std::ssize(walks.stops.stops[at].neighbors);
      if (count == walks.stops.neighbors || (kind == 2 && count >= kNeighbors)) break;
      walks.stops.add_neighbor(at, to);
    }
  }
  return walks;
}

// A state, and the least cost up to it.
struct Known {
  StopSet left;
  int at;
  Time cost;
};
using Layers = std::vector<std::vector<Known>>;  // by the number of visited stops, minus 1

// The states of all sequences of a price <= `limit`. `outside_bound` becomes the least bound of a
// state that is left out. Returns nullopt if there are too many states, or if a limit was reached.
std::optional<Layers> layers_within(const CostMatrix& matrix, const CompletionBounds& bounds,
                                    Time limit, const Limits& limits, Time& outside_bound) {
  Layers layers(1);
  const auto reach = [&](std::vector<Known>& layer, StopSet left, int stop, Time cost) {
    const Time price = add_costs(cost, bounds.from(stop, left));
    if (price <= limit)
      layer.push_back({left, stop, cost});
    else
      outside_bound = std::min(outside_bound, price);
  };
  for (int stop = 0; stop < matrix.stops(); ++stop)
    reach(layers[0], matrix.all() & ~bit(stop), stop, matrix.from_start(stop));
  std::size_t count = 0;
  while (!layers.back().empty()) {
    std::vector<Known>& layer = layers.back();
    std::ranges::sort(layer, {}, [](const Known& s) { return std::tuple(s.left, s.at, s.cost); });
    const auto same = [](const Known& a, const Known& b) {
      return a.left == b.left && a.at == b.at;
    };
    layer.erase(std::unique(layer.begin(), layer.end(), same), layer.end());
    count += layer.size();
    if (count > OptionalStopsDag::kMaxStates) return std::nullopt;
    std::vector<Known> next;
    for (const Known& state : layer) {
      if (next.size() > kMaxReached || limits.stop_requested()) return std::nullopt;
      for_each_stop(state.left, [&](int stop) {
        reach(next, state.left & ~bit(stop), stop,
              add_costs(state.cost, matrix.between(state.at, stop)));
      });
    }
    layers.push_back(std::move(next));
  }
  return layers;
}

}  // namespace

Time price_without(const std::vector<Time>& skip, StopSet set) {
  Time price = 0;
  for_each_stop(set,
                [&](int stop) { price = add_costs(price, skip[static_cast<std::size_t>(stop)]); });
  return price;
}

std::optional<CompletionBounds> CompletionBounds::make(const CostMatrix& matrix,
                                                       const std::vector<Time>& skip,
                                                       const std::vector<StopSet>& neighborhoods,
                                                       const Limits& limits) {
  GROVE_CHECK(matrix.ports == 1, "completions are from stops, not from ports");
  ReverseWalks reverse = reverse_walks(matrix, skip, neighborhoods);
  NgWalks walks;
  for (bool found = false; !found;) {
    switch (walks.find(reverse.stops, reverse.prizes, kMaxEffort - walks.effort(), limits)) {
      case NgWalks::Outcome::kFound:
        found = true;
        break;
      case NgWalks::Outcome::kNegativeCycle:
        if (reverse.stops.forbid_cycle(walks.cycle()).empty()) return std::nullopt;
        break;
      case NgWalks::Outcome::kStopped:
        return std::nullopt;
    }
  }
  CompletionBounds bounds;
  bounds.skip_ = skip;
  for (int i = 0; i < reverse.stops.remembered; ++i) bounds.required_ |= bit(reverse.order[i]);
  bounds.completions_.resize(static_cast<std::size_t>(matrix.stops()));
  for (const NgWalks::LabelId label : walks.labels()) {
    const std::int32_t at = walks.stop(label);
    StopSet visited = 0;
    for (std::int32_t i = 0; i < std::ssize(reverse.order); ++i)
      if ((walks.memory(label) & reverse.stops.bits_of(at, i)) != 0)
        visited |= bit(reverse.order[i]);
    const int stop = reverse.order[at];
    visited &= ~bit(stop);
    bounds.completions_[static_cast<std::size_t>(stop)].push_back(
        {walks.cost(label) + reverse.prizes[at], visited & bounds.required_,
         visited & ~bounds.required_});
  }
  for (auto& of_stop : bounds.completions_)
    std::ranges::stable_sort(of_stop, {}, &Completion::cost);
  return bounds;
}

Time CompletionBounds::from(int stop, StopSet left) const {
  Time price = 0;
  for_each_stop(left, [&](int other) {
    if (!must_visit(skip_, other)) price += skip_[static_cast<std::size_t>(other)];
  });
  for (const Completion& completion : completions_[static_cast<std::size_t>(stop)])
    if (completion.required == (left & required_) && (completion.others & ~left) == 0)
      return static_cast<Time>(std::clamp<std::int64_t>(price + completion.cost, 0, kNever));
  return kNever;
}

std::optional<OptionalStopsDag> OptionalStopsDag::build(const CostMatrix& matrix,
                                                        const std::vector<Time>& skip,
                                                        const CompletionBounds& bounds, Time limit,
                                                        const Limits& limits) {
  OptionalStopsDag dag(kNever);
  const auto layers = layers_within(matrix, bounds, limit, limits, dag.outside_bound_);
  if (!layers) return std::nullopt;
  for (const std::vector<Known>& layer : *layers)
    for (const Known& state : layer) {
      if (dag.nodes_.empty() || dag.nodes_.back().left != state.left) {
        dag.index_.insert(state.left, static_cast<std::uint32_t>(dag.nodes_.size()));
        dag.nodes_.push_back({state.left, 0, static_cast<std::uint32_t>(dag.price_to_go_.size())});
      }
      dag.nodes_.back().at |= bit(state.at);
      dag.price_to_go_.push_back(kNever);
    }
  for (std::size_t i = dag.nodes_.size(); i-- > 0;) {
    const Node& node = dag.nodes_[i];
    std::uint32_t index = node.first;
    for_each_stop(node.at, [&](int stop) {
      Time least = add_costs(matrix.to_end(stop), price_without(skip, node.left));
      for_each_stop(node.left, [&](int next) {
        least = std::min(least, add_costs(matrix.between(stop, next),
                                          dag.price_to_go(node.left & ~bit(next), next)));
      });
      dag.price_to_go_[index++] = least;
    });
  }
  return dag;
}

Time OptionalStopsDag::price_to_go(StopSet left, int stop) const {
  const std::uint32_t found = index_.find(left);
  if (found == StopSetIndex::kAbsent) return kNever;
  const Node& node = nodes_[found];
  if ((node.at & bit(stop)) == 0) return kNever;
  return price_to_go_[node.first +
                      static_cast<std::uint32_t>(std::popcount(node.at & (bit(stop) - 1)))];
}

}  // namespace grove::detail
