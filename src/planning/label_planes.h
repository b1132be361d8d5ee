// SPDX-License-Identifier: MIT
// The labels of a search over few of very many states.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <vector>

#include "grove/detail/model/assert.h"
#include "grove/detail/model/limits.h"

namespace grove::detail {

// One *plane* of labels, by slot, for each state that a search touches; planes are made when first
// needed and reused from search to search. Nothing is cleared: what an earlier search wrote has an
// earlier stamp. Memory that no label was written to is never touched, so on a large map a plane
// costs what the search sees of it. A label is what the search makes of it, with a `stamp`, to be
// set when the others are.
template <class Label>
requires std::is_trivial_v<Label> && std::same_as<decltype(Label::stamp), std::uint32_t>
class LabelPlanes {
 public:
  // Forgets all labels.
  void begin_search(int slots) {
    if (static_cast<std::size_t>(slots) > capacity_) {
      pool_.clear();
      // Tight at first, since memory may be short; but reservations grow path by path.
      const std::size_t tight =
          static_cast<std::size_t>(slots) + static_cast<std::size_t>(slots) / 8 + kSpare;
      capacity_ = std::max(tight, capacity_ + capacity_ / 2);
    }
    if (++stamp_ == 0) {
      pool_.clear();
      by_state_.clear();
      stamp_ = 1;
    }
    used_ = 0;
    exhausted_ = false;
  }

  // Makes sure that the state has a plane. False, and exhausted(), when memory is refused.
  bool open(std::int32_t state, const Limits& limits) {
    if (static_cast<std::size_t>(state) < by_state_.size() && by_state_[state].stamp == stamp_)
      return true;
    return add(state, limits);
  }
  bool exhausted() const { return exhausted_; }

  // The state must be open.
  Label& label(std::int32_t slot, std::int32_t state) {
    GROVE_ASSERT(by_state_[state].stamp == stamp_, "labels are asked for of an open state");
    return by_state_[state].labels[slot];
  }
  bool is_current(const Label& label) const { return label.stamp == stamp_; }
  std::uint32_t stamp() const { return stamp_; }

 private:
  static constexpr std::size_t kSpare = 64;
  // Memory is asked for by the piece, of one or more planes.
  static constexpr std::size_t kPiece_bytes = std::size_t{16} << 20;
  static constexpr std::size_t kMostPlanesPerPiece = 16;

  struct Free {
    void operator()(Label* labels) const { std::free(labels); }
  };
  using Plane = std::unique_ptr<Label[], Free>;
  struct Use {
    Label* labels = nullptr;
    std::uint32_t stamp = 0;
  };

  bool add(std::int32_t state, const Limits& limits) {
    if (exhausted_ || (used_ == pool_.size() && !add_plane(limits))) {
      if (!exhausted_) limits.memory_exhausted();
      exhausted_ = true;
      return false;
    }
    if (static_cast<std::size_t>(state) >= by_state_.size())
      by_state_.resize(2 * static_cast<std::size_t>(state) + 1);
    by_state_[state] = {pool_[used_++].get(), stamp_};
    return true;
  }

  bool add_plane(const Limits& limits) {
    const std::size_t bytes = capacity_ * sizeof(Label);
    const std::size_t planes =
        std::clamp<std::size_t>(kPiece_bytes / bytes, 1, kMostPlanesPerPiece);
    if (pool_.size() % planes == 0 && !limits.memory_allows(planes * bytes)) return false;
    Plane plane(static_cast<Label*>(std::calloc(capacity_, sizeof(Label))));
    if (!plane) return false;
    pool_.push_back(std::move(plane));
    return true;
  }

  std::size_t capacity_ = 0;  // of a plane
  std::vector<Plane> pool_;
  std::size_t used_ = 0;
  std::vector<Use> by_state_;
  std::uint32_t stamp_ = 0;
  bool exhausted_ = false;
};

}  // namespace grove::detail
