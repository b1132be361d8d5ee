// SPDX-License-Identifier: MIT
// Compact hash set of LaCAM configurations.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "primal/visit_stages.h"

namespace grove::detail {

// One agent in a configuration: its state, and the stage that identifies its remaining stops.
struct AgentState {
  State state;
  VisitStages::Stage stage;
  friend bool operator==(const AgentState&, const AgentState&) = default;
};

// Rows of equal length, numbered from 0, in blocks that never move in memory.
template <class T>
class RowBlocks {
 public:
  explicit RowBlocks(std::size_t width)
      : width_(width), per_block_(std::max<std::size_t>(1, kBlockBytes / (width * sizeof(T)))) {}

  std::span<T> operator[](std::int32_t row) {
    const auto i = static_cast<std::size_t>(row);
    return {blocks_[i / per_block_].get() + i % per_block_ * width_, width_};
  }
  std::int32_t count() const { return count_; }
  // Number of bytes that the next add() allocates.
  std::size_t growth() const { return is_full() ? per_block_ * width_ * sizeof(T) : 0; }
  std::span<T> add() {
    if (is_full()) blocks_.push_back(std::make_unique<T[]>(per_block_ * width_));
    return (*this)[count_++];
  }

 private:
  static constexpr std::size_t kBlockBytes = 1 << 18;

  bool is_full() const { return static_cast<std::size_t>(count_) == blocks_.size() * per_block_; }

  std::size_t width_;
  std::size_t per_block_;
  std::int32_t count_ = 0;
  std::vector<std::unique_ptr<T[]>> blocks_;
};

// A hash set of configurations, numbered in the order of insertion. A configuration is one
// AgentState per agent. One thread at a time.
class Configurations {
 public:
  using Id = std::int32_t;

  explicit Configurations(int agents);

  std::span<const AgentState> operator[](Id id) { return places_[id]; }
  Id count() const { return places_.count(); }

  // Inserts `places` and returns its number, which is count() - 1 if it is new.
  Id insert(std::span<const AgentState> places);
  // Maximum number of bytes that the next insert() allocates for rows and slots.
  std::size_t growth() const;

 private:
  static constexpr Id kNone = -1;

  std::size_t slot_of(std::span<const AgentState> places, std::uint64_t hash);
  void rehash();

  RowBlocks<AgentState> places_;
  std::vector<std::uint64_t> hashes_;  // by Id
  std::vector<Id> slots_;              // open addressing, at most half full
};

}  // namespace grove::detail
