// SPDX-License-Identifier: MIT
#include "planning/conflict_avoidance_table.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kMaxWaitConflicts = 1 << 20;
constexpr int kFirstBits = 10;
constexpr std::size_t kSparsity = 4;  // entries per key, at least

}  // namespace

ConflictAvoidanceTable::ConflictAvoidanceTable(const World& world)
    : world_(world),
      counts_(std::size_t{1} << kFirstBits),
      visited_(world.place_count()),
      mask_(counts_.size() - 1),
      stride_(static_cast<std::uint64_t>(world.place_count()) | 1),
      first_rest_(world.place_count(), kNever) {}

int ConflictAvoidanceTable::direction_on_roads(const World& world, Place from, Place to) {
  const auto neighbors = world.neighbors(to);
  return std::min(static_cast<int>(std::ranges::find(neighbors, from) - neighbors.begin()), 3);
}

// Ensures that `steps` more keys fit. If necessary, starts a new generation with the counts in use,
// in the same memory if that suffices, and drops counts of removed paths.
void ConflictAvoidanceTable::make_room(std::size_t steps) {
  if (kSparsity * (keys_ + steps) <= counts_.size()) return;
  in_use_.clear();
  std::ranges::copy_if(counts_, std::back_inserter(in_use_), [&](const Counts& counts) {
    return is_current(counts.key) && counts.visits > 0;
  });
  const std::size_t size = std::bit_ceil(2 * kSparsity * (in_use_.size() + steps));
  if (size > counts_.size()) counts_ = std::vector<Counts>(size);
  mask_ = counts_.size() - 1;
  keys_ = in_use_.size();
  begin_generation();
  for (Counts& counts : in_use_) {
    const auto place = static_cast<Place>(counts.key & ((std::uint64_t{1} << kPlaceBits) - 1));
    const auto time = static_cast<Time>(counts.key >> kPlaceBits & kLastTime);
    counts.key = key(place, time);
    GROVE_ASSERT(counts_[slot(counts.key)].key != counts.key, "a place and time has one entry");
    counts_[slot(counts.key)] = counts;
    mark(place, time);
  }
  GROVE_ASSERT(kSparsity * (keys_ + steps) <= counts_.size(), "there is room for the new steps");
}

void ConflictAvoidanceTable::begin_generation() {
  if (generation_++ < kLastGeneration) return;
  std::ranges::fill(counts_, Counts{});
  std::ranges::fill(visited_, Visited{});
  generation_ = 1;
}

void ConflictAvoidanceTable::mark(Place place, Time time) {
  Visited& visited = visited_[place];
  if (visited.generation != generation_) visited = {static_cast<std::uint32_t>(generation_), 0};
  visited.times |= time_bit(time);
}

ConflictAvoidanceTable::Counts& ConflictAvoidanceTable::insert(std::uint64_t key) {
  Counts& counts = counts_[slot(key)];
  if (counts.key != key) {
    counts = {.key = key};
    ++keys_;
  }
  return counts;
}

void ConflictAvoidanceTable::add(const Path& path) {
  if (path.empty()) return;
  make_room(path.size());
  const auto rest = static_cast<Time>(path.size() - 1);
  Place before = kNoPlace;
  for (Time t = 0; t <= std::min(rest, kLastTime); ++t) {
    const Place place = world_.place(path[t]);
    mark(place, t);
    Counts& counts = insert(key(place, t));
    GROVE_ASSERT(counts.visits < UINT16_MAX, "the number of visits fits into 16 bits");
    ++counts.visits;
    if (t > 0 && before != place) ++counts.moves[direction(world_, before, place)];
    before = place;
  }
  const Place end = world_.place(path.back());
  horizon_ = std::max(horizon_, std::min(rest, kLastTime));
  rests_.push_back({end, rest});
  first_rest_[end] = std::min(first_rest_[end], rest);
}

void ConflictAvoidanceTable::remove(const Path& path) {
  if (path.empty()) return;
  const auto since = static_cast<Time>(path.size() - 1);
  Place before = kNoPlace;
  for (Time t = 0; t <= std::min(since, kLastTime); ++t) {
    const Place place = world_.place(path[t]);
    Counts& counts = counts_[slot(key(place, t))];
    GROVE_ASSERT(counts.key == key(place, t) && counts.visits > 0,
                 "only a path in the table is removed");
    --counts.visits;
    if (t > 0 && before != place) {
      GROVE_ASSERT(counts.moves[direction(world_, before, place)] > 0,
                   "only a move in the table is removed");
      --counts.moves[direction(world_, before, place)];
    }
    before = place;
  }
  const Place end = world_.place(path.back());
  const auto gone = std::ranges::find_if(
      rests_, [&](const Rest& rest) { return rest.place == end && rest.since == since; });
  GROVE_ASSERT(gone != rests_.end(), "only a path in the table is removed");
  *gone = rests_.back();
  rests_.pop_back();
  first_rest_[end] = kNever;
  for (const Rest& rest : rests_)
    if (rest.place == end) first_rest_[end] = std::min(first_rest_[end], rest.since);
  GROVE_ASSERT(!rests_.empty() || first_rest_[end] == kNever,
               "in an empty table no path rests on a place");
}

void ConflictAvoidanceTable::clear() {
  begin_generation();
  for (const Rest& rest : rests_) first_rest_[rest.place] = kNever;
  rests_.clear();
  keys_ = 0;
  horizon_ = 0;
}

int ConflictAvoidanceTable::rests_before(Place place, Time time) const {
  return static_cast<int>(std::ranges::count_if(
      rests_, [&](const Rest& rest) { return rest.place == place && rest.since < time; }));
}

int ConflictAvoidanceTable::conflicts_of_waiting(Place place, Time first, Time last) const {
  std::int64_t count = 0;
  for (Time t = first; t <= std::min(last, horizon_); ++t) count += visits(place, t);
  if (last > first_rest_[place])
    for (const Rest& rest : rests_)
      if (rest.place == place) count += std::max(0, last - std::max(first - 1, rest.since));
  return static_cast<int>(std::min(count, kMaxWaitConflicts));
}

int ConflictAvoidanceTable::conflicts_of_resting(Place place, Time time) const {
  // A path that comes to rest after `time` is counted by its visits up to its first time of rest.
  int count = first_rest_[place] <= time ? rests_before(place, time + 1) : 0;
  for (Time t = time + 1; t <= horizon_; ++t) count += visits(place, t);
  return count;
}

int ConflictAvoidanceTable::conflicts_of(const Path& path) const {
  GROVE_ASSERT(!path.empty(), "a path is not empty");
  int count = 0;
  for (std::size_t t = 1; t < path.size(); ++t)
    count += conflicts(world_.place(path[t - 1]), world_.place(path[t]), static_cast<Time>(t));
  return count +
         conflicts_of_resting(world_.place(path.back()), static_cast<Time>(path.size()) - 1);
}

}  // namespace grove::detail
