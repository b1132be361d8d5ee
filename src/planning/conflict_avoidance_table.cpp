// SPDX-License-Identifier: MIT
#include "grove/planning/conflict_avoidance_table.h"

#include <algorithm>
#include <limits>

namespace grove {
namespace {

// A counter that is full stays full until clear(): the table only breaks ties, and a cell that 255
// paths share is to be avoided whatever their number.
constexpr std::uint8_t kFull = std::numeric_limits<std::uint8_t>::max();

void increment(std::uint8_t& count) {
  if (count != kFull) ++count;
}

void decrement(std::uint8_t& count) {
  if (count != kFull) --count;
}

constexpr std::int64_t kMostWaitConflicts = 1 << 20;

}  // namespace

ConflictAvoidanceTable::ConflictAvoidanceTable(const Grid& grid)
    : cells_(grid.cell_count()),
      first_rest_(grid.cell_count(), kNever),
      rests_(grid.cell_count()) {}

void ConflictAvoidanceTable::reserve(std::size_t steps) {
  if (steps <= static_cast<std::size_t>(horizon_)) return;
  counts_.resize(steps * static_cast<std::size_t>(cells_));
  horizon_ = static_cast<Time>(steps);
}

void ConflictAvoidanceTable::remember_touched(std::size_t place) {
  if (touched_.size() < counts_.size() / 8)
    touched_.push_back(place);
  else
    touched_too_many_ = true;
}

void ConflictAvoidanceTable::add(const Path& path) {
  if (path.empty()) return;
  reserve(path.size());
  for (std::size_t t = 0; t < path.size(); ++t) {
    const std::size_t place = index(path[t], static_cast<Time>(t));
    Counts& counts = counts_[place];
    if (counts.visits == 0) remember_touched(place);
    increment(counts.visits);
    if (t > 0 && path[t - 1] != path[t]) increment(counts.moves[direction(path[t - 1], path[t])]);
  }
  const Cell end = path.back();
  const auto rest = static_cast<Time>(path.size() - 1);
  if (rests_[end].empty()) rested_.push_back(end);
  rests_[end].push_back(rest);
  first_rest_[end] = std::min(first_rest_[end], rest);
}

void ConflictAvoidanceTable::remove(const Path& path) {
  if (path.empty()) return;
  for (std::size_t t = 0; t < path.size(); ++t) {
    Counts& counts = counts_[index(path[t], static_cast<Time>(t))];
    decrement(counts.visits);
    if (t > 0 && path[t - 1] != path[t]) decrement(counts.moves[direction(path[t - 1], path[t])]);
  }
  std::vector<Time>& rests = rests_[path.back()];
  rests.erase(std::ranges::find(rests, static_cast<Time>(path.size() - 1)));
  first_rest_[path.back()] = rests.empty() ? kNever : *std::ranges::min_element(rests);
  if (rests.empty()) std::erase(rested_, path.back());
}

void ConflictAvoidanceTable::forget_counts() {
  if (touched_too_many_)
    std::ranges::fill(counts_, Counts{});
  else
    for (std::size_t place : touched_) counts_[place] = Counts{};
  touched_.clear();
  touched_too_many_ = false;
}

void ConflictAvoidanceTable::clear() {
  forget_counts();
  for (Cell cell : rested_) {
    rests_[cell].clear();
    first_rest_[cell] = kNever;
  }
  rested_.clear();
}

int ConflictAvoidanceTable::rests_before(Cell cell, Time time) const {
  return static_cast<int>(
      std::ranges::count_if(rests_[cell], [time](Time rest) { return rest < time; }));
}

int ConflictAvoidanceTable::conflicts_of_waiting(Cell cell, Time first, Time last) const {
  std::int64_t count = 0;
  for (Time t = first; t <= std::min(last, horizon_ - 1); ++t)
    count += counts_[index(cell, t)].visits;
  if (last > first_rest_[cell])
    for (Time rest : rests_[cell]) count += std::max(0, last - std::max(first - 1, rest));
  return static_cast<int>(std::min(count, kMostWaitConflicts));
}

int ConflictAvoidanceTable::conflicts_of_resting(Cell cell, Time time) const {
  // A path that comes to rest after `time` is counted when it arrives.
  int count = first_rest_[cell] <= time ? rests_before(cell, time + 1) : 0;
  for (Time t = time + 1; t < horizon_; ++t) count += counts_[index(cell, t)].visits;
  return count;
}

}  // namespace grove
