// SPDX-License-Identifier: MIT
// Walks through the stops of one agent that collect prizes: a relaxation of its routes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "model/limits.h"

namespace grove::detail {

// ng-routes (Baldacci, Mingozzi and Roberti 2011). A walk goes from a start through stops, along
// legs with costs, and collects the prize of a stop at each visit. It may repeat visits. A label at
// stop u remembers the visits of the walk in the neighbourhood N(u) only, and on the way to v it
// forgets those outside N(v). It does not repeat a visit that it remembers. A few stops are always
// remembered. So every route is such a walk, and the least reduced cost of a label, which is the
// cost minus the prizes, is a lower bound for the routes. Neighbourhoods can grow where walks
// repeat visits.
class NgStops {
 public:
  using Memory = std::uint32_t;
  // Memory has one bit for each stop that is always remembered, then one for each neighbour.
  static constexpr int kMaxBits = 13;
  static constexpr std::int64_t kNoWalk = std::numeric_limits<std::int64_t>::max() / 4;

  struct Leg {
    std::int32_t to;
    std::int64_t cost;
    // If not 0: only labels that remember one of these visits make the leg. For the others there
    // must be legs through the visits that cost no more.
    Memory needed;
  };
  struct Stop {
    std::int64_t first = kNoWalk;  // cost of the leg from the start; kNoWalk: there is none
    std::vector<std::int32_t> neighbors = {};  // by bit; the stop itself comes first
    std::vector<Leg> legs = {};
  };

  std::vector<Stop> stops;  // those that are always remembered come first
  int remembered = 0;       // their number
  int neighbors = 0;        // the greatest number of neighbours of a stop

  int bits() const { return remembered + neighbors; }
  // The bit by which a label at the stop `at` can remember `stop`; 0: it cannot.
  Memory bits_of(std::int32_t at, std::int32_t stop) const {
    if (stop < remembered) return Memory{1} << stop;
    const std::int8_t position =
        positions_.empty() ? find(at, stop)
                           : positions_[static_cast<std::size_t>(at) * stops.size() + stop];
    return position < 0 ? 0 : Memory{1} << (remembered + position);
  }
  // Adds `stop` to the neighbourhood of `at`. Requires that all stops exist.
  void add_neighbor(std::int32_t at, std::int32_t stop);

  // Adds one stop of `cycle` to the neighbourhoods of the others, if there is room, so that no walk
  // repeats this stop along `cycle`. Returns the stops with a new neighbour.
  std::vector<std::int32_t> forbid_cycle(std::span<const std::int32_t> cycle);

 private:
  std::int8_t find(std::int32_t at, std::int32_t stop) const;

  std::vector<std::int8_t> positions_;  // by two stops: of the second among the neighbours of the
                                        // first; empty if there are many stops
};

// Label-correcting algorithm for ng-routes. One thread at a time.
class NgWalks {
 public:
  using Memory = NgStops::Memory;
  // A label: its stop and what it remembers.
  using LabelId = std::int32_t;
  static constexpr LabelId kStart = -1;
  enum class Outcome : std::uint8_t {
    kFound,
    kNegativeCycle,  // some labels have no least cost: a cycle has a negative reduced cost
    kStopped,        // a limit was reached, or `max_effort`
  };

  // Finds the labels of least reduced cost. `prizes`: by stop. `stops` must exist until the next
  // call.
  Outcome find(const NgStops& stops, std::span<const std::int64_t> prizes, std::int64_t max_effort,
               const Limits& limits);

  // After kFound: the labels, their reduced costs, and the labels before them on their walks.
  std::span<const LabelId> labels() const { return reached_; }
  std::int64_t cost(LabelId label) const { return labels_[label].cost; }
  LabelId parent(LabelId label) const { return labels_[label].parent; }
  std::int32_t stop(LabelId label) const { return label >> stops_->bits(); }
  Memory memory(LabelId label) const {
    return static_cast<Memory>(label) & ((Memory{1} << stops_->bits()) - 1);
  }
  // After kNegativeCycle: the stops of a cycle with a negative reduced cost, in reverse order.
  std::vector<std::int32_t> cycle() const;
  // After kFound: the first cycle on the walk of a label, in reverse order; empty: there is none.
  std::vector<std::int32_t> cycle_before(LabelId label) const;
  // The number of legs scanned by all calls of find().
  std::int64_t effort() const { return effort_; }

 private:
  struct Label {
    std::int64_t cost = NgStops::kNoWalk;
    LabelId parent = kStart;
    std::int32_t round = -1;  // in which it was reached last
  };

  void extend(LabelId from, std::int32_t round);
  void reach(std::int32_t stop, Memory memory, std::int64_t cost, LabelId parent,
             std::int32_t round);
  Memory memory_after(LabelId from, std::int32_t to) const;
  bool has_cycle(LabelId label);

  const NgStops* stops_ = nullptr;
  std::span<const std::int64_t> prizes_;
  std::vector<Label> labels_;     // by LabelId
  std::vector<LabelId> reached_;  // those of labels_ with a cost
  std::vector<LabelId> now_;      // reached in the last round
  std::vector<LabelId> next_;     // reached in this round
  LabelId on_cycle_ = kStart;     // after kNegativeCycle
  std::int64_t effort_ = 0;
};

}  // namespace grove::detail
