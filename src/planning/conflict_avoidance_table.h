// SPDX-License-Identifier: MIT
// Where the other agents are: the tie-breaker of the low level, never a constraint.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/plan.h"
#include "model/world.h"

namespace grove::detail {

// Counts, per place and time and per move and time, the paths that use it (fewer than 65,536). One
// per thread. A hash table of what the paths touch, whatever the size of the map: about 100 bytes
// per step of a path, which stays in the cache where a full table would not.
class ConflictAvoidanceTable {
 public:
  // `world` must outlive this.
  explicit ConflictAvoidanceTable(const World& world);

  // A path that is empty (an agent not yet planned) adds nothing.
  void add(const Path& path);
  // `path` must have been added.
  void remove(const Path& path);
  // Removes every path. O(size of what was added).
  void clear();

  // Vertex and edge conflicts of arriving on `to` at time `time` coming from `from` (equal: a
  // wait).
  int conflicts(Place from, Place to, Time time) const {
    const int count = vertex_conflicts(to, time);
    return from == to ? count : count + comers(from, time).from(to);
  }
  // The vertex conflicts alone.
  int vertex_conflicts(Place place, Time time) const {
    const int count = visits(place, time);
    return time > first_rest_[place] ? count + rests_before(place, time) : count;
  }
  // The paths that come to a place at a time; until the table is changed.
  class Arrivals {
   public:
    // How many come from this neighbor: the edge conflicts of a move there.
    int from(Place neighbor) const {
      return moves_ == nullptr ? 0 : (*moves_)[direction(*world_, neighbor, place_)];
    }

   private:
    friend class ConflictAvoidanceTable;
    using Moves = std::array<std::uint16_t, 4>;
    const World* world_ = nullptr;
    const Moves* moves_ = nullptr;
    Place place_ = kNoPlace;
  };
  Arrivals comers(Place place, Time time) const {
    Arrivals comers;
    comers.world_ = &world_;
    comers.place_ = place;
    if (const Counts* counts = counts_of(place, time)) comers.moves_ = &counts->moves;
    return comers;
  }
  // The vertex conflicts of waiting on `place` from time `first` to time `last`, summed up.
  int conflicts_of_waiting(Place place, Time first, Time last) const;
  // How many times a path passes `place` after `time`, or rests there (which counts once): what
  // resting there from `time` on would run into.
  int conflicts_of_resting(Place place, Time time) const;
  // The conflicts of a whole path (not empty), step by step, and of the rest after it.
  int conflicts_of(const Path& path) const;

 private:
  // The paths on a place at a time, and those of them that just came from a neighbor, by direction.
  struct Counts {
    std::uint64_t key = 0;     // 0: never used
    std::uint16_t visits = 0;  // 0: left over from paths that were removed
    std::array<std::uint16_t, 4> moves{};
  };
  // An agent that rests is not counted step by step: it would never end.
  struct Rest {
    Place place;
    Time since;
  };

  // A key is of one generation: entries of older ones count as free.
  // Later times than kLastTime are not counted.
  static constexpr int kPlaceBits = 27;
  static constexpr int kTimeBits = 21;
  static constexpr std::uint64_t kLastGeneration = 0xFFFF;
  static constexpr Time kLastTime = (1 << kTimeBits) - 1;

  std::uint64_t key(Place place, Time time) const {
    return (generation_ << kTimeBits | static_cast<std::uint64_t>(time)) << kPlaceBits |
           static_cast<std::uint64_t>(place);
  }
  bool is_current(std::uint64_t key) const {
    return key >> (kTimeBits + kPlaceBits) == generation_;
  }
  // One of four for each neighbor; where there are more, several share the last.
  static int direction(const World& world, Place from, Place to) {
    if (world.row_width() == 0) return direction_on_roads(world, from, to);
    const Place delta = to - from;
    const bool along_row = delta == 1 || delta == -1;
    return 2 * static_cast<int>(along_row) + static_cast<int>(delta > 0);
  }
  static int direction_on_roads(const World& world, Place from, Place to);
  // Where the counts of a key are, or would go: open addressing, at most a quarter full. The place
  // is a full table's, folded, so that neighbors at one time share a cache line.
  std::size_t slot(std::uint64_t key) const {
    const std::uint64_t place = key & ((std::uint64_t{1} << kPlaceBits) - 1);
    const std::uint64_t time = key >> kPlaceBits & kLastTime;
    std::size_t at = (time * stride_ + place) & mask_;
    while (counts_[at].key != key && is_current(counts_[at].key)) at = (at + 1) & mask_;
    return at;
  }
  // Null: no path was there.
  const Counts* counts_of(Place place, Time time) const {
    if (!perhaps(place, time)) return nullptr;
    const Counts& counts = counts_[slot(key(place, time))];
    return counts.key == key(place, time) ? &counts : nullptr;
  }
  int visits(Place place, Time time) const {
    const Counts* counts = counts_of(place, time);
    return counts ? counts->visits : 0;
  }
  // Few places are visited at a given time: one small array settles most questions. Bits of paths
  // that were removed may stay on for a while.
  struct Visited {
    std::uint32_t generation = 0;
    std::uint32_t times = 0;  // a bit for kTimesPerBit times, over and over
  };
  static constexpr int kTimesPerBit = 8;
  static std::uint32_t time_bit(Time time) {
    return std::uint32_t{1} << (static_cast<std::uint32_t>(time) / kTimesPerBit % 32);
  }
  // False: no path is on this place at this time, unless it rests there.
  bool perhaps(Place place, Time time) const {
    const Visited& visited = visited_[place];
    return (visited.times & time_bit(time)) != 0 && visited.generation == generation_;
  }
  void mark(Place place, Time time);

  Counts& insert(std::uint64_t key);
  int rests_before(Place place, Time time) const;
  void make_room(std::size_t steps);
  void begin_generation();

  const World& world_;
  std::vector<Counts> counts_;    // a power of two
  std::vector<Visited> visited_;  // by place
  std::size_t mask_;              // counts_.size() - 1
  std::uint64_t stride_;          // of time: odd, so that no two times fold onto each other early
  std::uint64_t generation_ = 1;
  std::size_t keys_ = 0;          // of this generation, left-overs included
  Time horizon_ = 0;              // no path added since the last clear() moves after this time
  std::vector<Time> first_rest_;  // by place: when the first path comes to rest there
  std::vector<Rest> rests_;
  std::vector<Counts> in_use_;  // scratch of make_room()
};

}  // namespace grove::detail
