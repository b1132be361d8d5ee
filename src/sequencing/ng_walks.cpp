// SPDX-License-Identifier: MIT
// Label correcting, in rounds: round r extends the labels that round r - 1 has improved.
//
// *Dominance.* A label is dropped if another label at the same stop costs no more, has the same
// always remembered visits, and remembers no neighbour except the stop itself: each walk that
// extends the first extends the second, too. If legs are only for labels with some memory, this
// need not hold, but the least cost is still a lower bound for routes (assignment/agent_walks.cpp).
//
// If labels have no least cost, the parents of some label form a cycle (Cherkassky and Goldberg
// 1999), which is tested from time to time.
#include "sequencing/ng_walks.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::int32_t kRoundsPerTest = 8;
constexpr std::size_t kMaxIndexed = 256;  // stops with an index of positions
constexpr std::int8_t kNotFound = -1;

}  // namespace

std::int8_t NgStops::find(std::int32_t at, std::int32_t stop) const {
  const std::vector<std::int32_t>& near = stops[at].neighbors;
  const auto found = std::ranges::find(near, stop);
  return found == near.end() ? kNotFound : static_cast<std::int8_t>(found - near.begin());
}

void NgStops::add_neighbor(std::int32_t at, std::int32_t stop) {
  GROVE_ASSERT(std::ssize(stops[at].neighbors) < neighbors, "the neighbourhood has room");
  const std::size_t count = stops.size();
  if (positions_.empty() && count <= kMaxIndexed) positions_.assign(count * count, kNotFound);
  if (!positions_.empty())
    positions_[static_cast<std::size_t>(at) * count + static_cast<std::size_t>(stop)] =
        static_cast<std::int8_t>(stops[at].neighbors.size());
  stops[at].neighbors.push_back(stop);
}

// Of the stops of the cycle, the one that the fewest others must remember in addition.
std::vector<std::int32_t> NgStops::forbid_cycle(std::span<const std::int32_t> cycle) {
  std::vector<std::int32_t> best;
  for (const std::int32_t stop : cycle) {
    std::vector<std::int32_t> changed;
    bool is_possible = true;
    for (const std::int32_t at : cycle) {
      if (bits_of(at, stop) != 0) continue;
      is_possible &= std::ssize(stops[at].neighbors) < neighbors;
      changed.push_back(at);
    }
    if (!is_possible || changed.empty() || (!best.empty() && changed.size() >= best.size()))
      continue;
    best = std::move(changed);
    best.push_back(stop);
  }
  if (best.empty()) return best;
  const std::int32_t stop = best.back();
  best.pop_back();
  std::ranges::sort(best);
  const auto rest = std::ranges::unique(best);
  best.erase(rest.begin(), rest.end());
  for (const std::int32_t at : best) add_neighbor(at, stop);
  return best;
}

NgWalks::Outcome NgWalks::find(const NgStops& stops, std::span<const std::int64_t> prizes,
                               std::int64_t max_effort, const Limits& limits) {
  GROVE_ASSERT(stops.bits() <= NgStops::kMaxBits, "labels fit in memory");
  for (const LabelId label : reached_) labels_[label] = {};
  stops_ = &stops;
  prizes_ = prizes;
  labels_.resize(std::max(labels_.size(), stops.stops.size() << stops.bits()));
  reached_.clear();
  next_.clear();
  const std::int64_t end = effort_ + max_effort;
  for (std::int32_t to = 0; to < std::ssize(stops.stops); ++to)
    if (stops.stops[to].first < NgStops::kNoWalk)
      reach(to, stops.bits_of(to, to), stops.stops[to].first, kStart, 0);
  for (std::int32_t round = 1; !next_.empty(); ++round) {
    if (effort_ >= end || limits.stop_requested()) return Outcome::kStopped;
    if (round % kRoundsPerTest == 0 && has_cycle(next_.back())) return Outcome::kNegativeCycle;
    std::swap(now_, next_);
    next_.clear();
    for (const LabelId from : now_) extend(from, round);
  }
  return Outcome::kFound;
}

void NgWalks::extend(LabelId from, std::int32_t round) {
  const std::int32_t at = stop(from);
  const Memory remembered = memory(from);
  const std::int64_t cost = labels_[from].cost;
  effort_ += std::ssize(stops_->stops[at].legs);
  for (const NgStops::Leg& leg : stops_->stops[at].legs) {
    if ((remembered & stops_->bits_of(at, leg.to)) != 0) continue;
    if (leg.needed != 0 && (remembered & leg.needed) == 0) continue;
    reach(leg.to, memory_after(from, leg.to), cost + leg.cost, from, round);
  }
}

void NgWalks::reach(std::int32_t stop, Memory memory, std::int64_t cost, LabelId parent,
                    std::int32_t round) {
  cost -= prizes_[stop];
  const LabelId first = stop << stops_->bits();
  const Memory always = (Memory{1} << stops_->remembered) - 1;
  const Memory least = (memory & always) | stops_->bits_of(stop, stop);
  const LabelId at = first | static_cast<LabelId>(memory);
  Label& label = labels_[at];
  if (label.cost <= cost || labels_[first | static_cast<LabelId>(least)].cost <= cost) return;
  if (label.round < 0) reached_.push_back(at);
  label.cost = cost;
  label.parent = parent;
  if (label.round == round) return;
  label.round = round;
  next_.push_back(at);
}

NgWalks::Memory NgWalks::memory_after(LabelId from, std::int32_t to) const {
  const Memory before = memory(from);
  const Memory always = (Memory{1} << stops_->remembered) - 1;
  Memory after = (before & always) | stops_->bits_of(to, to);
  const std::vector<std::int32_t>& neighbors = stops_->stops[stop(from)].neighbors;
  for (Memory rest = before >> stops_->remembered; rest != 0; rest &= rest - 1)
    after |= stops_->bits_of(to, neighbors[std::countr_zero(rest)]);
  return after;
}

bool NgWalks::has_cycle(LabelId label) {
  std::size_t steps = 0;
  for (; label != kStart && steps <= reached_.size(); ++steps) label = labels_[label].parent;
  on_cycle_ = label;
  return label != kStart;
}

std::vector<std::int32_t> NgWalks::cycle() const {
  std::vector<std::int32_t> stops;
  LabelId label = on_cycle_;
  do {
    stops.push_back(stop(label));
    label = labels_[label].parent;
  } while (label != on_cycle_);
  return stops;
}

std::vector<std::int32_t> NgWalks::cycle_before(LabelId label) const {
  std::vector<std::int32_t> stops;
  for (; label != kStart; label = labels_[label].parent) {
    const auto before = std::ranges::find(stops, stop(label));
    if (before != stops.end()) return {before, stops.end()};
    stops.push_back(stop(label));
  }
  return {};
}

}  // namespace grove::detail
