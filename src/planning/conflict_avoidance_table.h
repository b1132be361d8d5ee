// SPDX-License-Identifier: MIT
// Conflict avoidance table: counts conflicts with the paths of other agents. The low level breaks
// ties by it; it never constrains a path.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/plan.h"
#include "model/world.h"

namespace grove::detail {

// Counts the paths that use each (place, time) and each (move, time), for at most 65,535 paths. The
// counts are in a hash table of the (place, time) pairs on the paths, so their memory does not grow
// with the numbers of places and time steps: it is at least about 100 bytes per pair, and fits into
// the processor cache where a table of all pairs would not. Two further arrays take 12 bytes per
// place. Two counts are not exact: visits and moves after time 2^21 - 1 are not counted, and on a
// place with more than four neighbors, moves from the fourth and later neighbors are counted
// together. One thread at a time.
class ConflictAvoidanceTable {
 public:
  // `world` must outlive this object.
  explicit ConflictAvoidanceTable(const World& world);

  // An empty path (of an agent that is not yet planned) adds nothing.
  void add(const Path& path);
  // `path` must have been added.
  void remove(const Path& path);
  // Removes all paths. O(number of paths), amortized.
  void clear();

  // Number of vertex and edge conflicts of a step from `from` to `to` that arrives at `time` (a
  // wait if both places are equal).
  int conflicts(Place from, Place to, Time time) const {
    const int count = vertex_conflicts(to, time);
    return from == to ? count : count + arrivals(from, time).from(to);
  }
  // Number of vertex conflicts of an agent on `place` at `time`.
  int vertex_conflicts(Place place, Time time) const {
    const int count = visits(place, time);
    return time > first_rest_[place] ? count + rests_before(place, time) : count;
  }
  // The moves of all paths in the table that arrive on one place at one time. Valid until the table
  // changes.
  class Arrivals {
   public:
    // Number of paths that arrive from this neighbor. A move to the neighbor in the same step has
    // this number of edge conflicts.
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
  Arrivals arrivals(Place place, Time time) const {
    Arrivals arrivals;
    arrivals.world_ = &world_;
    arrivals.place_ = place;
    if (const Counts* counts = counts_of(place, time)) arrivals.moves_ = &counts->moves;
    return arrivals;
  }
  // Number of vertex conflicts of an agent that waits on `place` from time `first` to time `last`,
  // inclusive, summed over these times and cut off at 2^20.
  int conflicts_of_waiting(Place place, Time first, Time last) const;
  // Number of conflicts of an agent that rests on `place` from `time` on: the number of (path,
  // time) pairs on the place after `time`, where the final rest of a path counts once.
  int conflicts_of_resting(Place place, Time time) const;
  // Number of conflicts of all steps of `path` (not empty) and of its final rest.
  int conflicts_of(const Path& path) const;

 private:
  // Number of paths on one place at one time, and of those that have just arrived from each
  // neighbor, by direction.
  struct Counts {
    std::uint64_t key = 0;     // 0: never used
    std::uint16_t visits = 0;  // 0: all paths that were here are removed
    std::array<std::uint16_t, 4> moves{};
  };
  // The final rest of a path. It has no entries by time step, because it never ends.
  struct Rest {
    Place place;
    Time since;
  };

  // A key contains its generation. Entries of older generations count as free. Times later than
  // kLastTime are not counted.
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
  // Index of the direction of a move, 0 to 3, different for each neighbor. If a place has more than
  // four neighbors, those from the fourth on share index 3.
  static int direction(const World& world, Place from, Place to) {
    if (world.row_width() == 0) return direction_on_roads(world, from, to);
    const Place delta = to - from;
    const bool along_row = delta == 1 || delta == -1;
    return 2 * static_cast<int>(along_row) + static_cast<int>(delta > 0);
  }
  static int direction_on_roads(const World& world, Place from, Place to);
  // Index of the counts of a key, or of the free entry for it. Open addressing, at most a quarter
  // full. The hash is the index into a table of all (time, place) pairs, modulo the size, so that
  // adjacent places at one time are often in one cache line.
  std::size_t slot(std::uint64_t key) const {
    const std::uint64_t place = key & ((std::uint64_t{1} << kPlaceBits) - 1);
    const std::uint64_t time = key >> kPlaceBits & kLastTime;
    std::size_t at = (time * stride_ + place) & mask_;
    while (counts_[at].key != key && is_current(counts_[at].key)) at = (at + 1) & mask_;
    return at;
  }
  // Returns the counts of this place and time; nullptr if no path visits the place then.
  const Counts* counts_of(Place place, Time time) const {
    if (!may_be_visited(place, time)) return nullptr;
    const Counts& counts = counts_[slot(key(place, time))];
    return counts.key == key(place, time) ? &counts : nullptr;
  }
  int visits(Place place, Time time) const {
    const Counts* counts = counts_of(place, time);
    return counts ? counts->visits : 0;
  }
  // Filter in front of the hash table. Few places are visited at a given time, so this small array
  // answers most queries. Bits of removed paths can remain set until the next generation.
  struct Visited {
    std::uint32_t generation = 0;
    std::uint32_t times = 0;  // bit t / kTimesPerBit % 32 is set if a path is here at time t
  };
  static constexpr int kTimesPerBit = 8;
  static std::uint32_t time_bit(Time time) {
    return std::uint32_t{1} << (static_cast<std::uint32_t>(time) / kTimesPerBit % 32);
  }
  // Returns false only if no path visits this place at this time. Final rests are not included.
  bool may_be_visited(Place place, Time time) const {
    const Visited& visited = visited_[place];
    return (visited.times & time_bit(time)) != 0 && visited.generation == generation_;
  }
  void mark(Place place, Time time);

  Counts& insert(std::uint64_t key);
  int rests_before(Place place, Time time) const;
  void make_room(std::size_t steps);
  void begin_generation();

  const World& world_;
  std::vector<Counts> counts_;    // hash table; its size is a power of two
  std::vector<Visited> visited_;  // by place
  std::size_t mask_;              // counts_.size() - 1
  std::uint64_t stride_;  // factor of the time in the hash; odd, so that on one place only times
                          // that differ by a multiple of the table size have the same hash
  std::uint64_t generation_ = 1;
  std::size_t keys_ = 0;          // keys of this generation, including those of removed paths
  Time horizon_ = 0;              // no visit after this time is counted
  std::vector<Time> first_rest_;  // by place: earliest time at which a path comes to rest there
  std::vector<Rest> rests_;
  std::vector<Counts> in_use_;  // scratch memory for make_room()
};

}  // namespace grove::detail
