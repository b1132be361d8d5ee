// SPDX-License-Identifier: MIT
// The labels of a search over few of very many states.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "grove/detail/model/assert.h"
#include "grove/detail/model/limits.h"

namespace grove::detail {

// One *plane* of labels, by slot, for each state that a search touches; planes are made when first
// needed and reused from search to search. Nothing is cleared: what an earlier search wrote has an
// earlier stamp. Memory that no label was written to is never touched, so on a large map a plane
// costs what searches have seen of it; when that may be much it is given back. A label is what the
// search makes of it, with a `stamp`, to be set when the others are.
template <class Label>
requires std::is_trivial_v<Label> && std::same_as<decltype(Label::stamp), std::uint32_t>
class LabelPlanes {
 public:
  // Forgets all labels. `written`: so many have been so far, about; 0: too few to count.
  void begin_search(int slots, std::int64_t written = 0) {
    if (written - written_before_ > kMostWritten && bytes() > kBytesKept) {
      pieces_.clear();
      written_before_ = written;
    }
    if (static_cast<std::size_t>(slots) > capacity_) {
      pieces_.clear();
      // Tight at first, since memory may be short; but reservations grow path by path.
      const std::size_t tight =
          static_cast<std::size_t>(slots) + static_cast<std::size_t>(slots) / 8 + kSpare;
      capacity_ = std::max(tight, capacity_ + capacity_ / 2);
      planes_per_piece_ = std::clamp<std::size_t>(kPieceBytes / (capacity_ * sizeof(Label)), 1,
                                                  kMostPlanesPerPiece);
    }
    if (++stamp_ == 0) {
      pieces_.clear();
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
  // Memory is asked for by the piece, of one or more planes: from the system, for the allocator
  // would clear what it has used before.
  static constexpr std::size_t kPieceBytes = std::size_t{16} << 20;
  static constexpr std::size_t kMostPlanesPerPiece = 16;
  // What many searches have touched here and there is given back after so many labels, unless it
  // is little. A label alone on its page costs two hundred times its size.
  static constexpr std::int64_t kMostWritten = 1 << 18;
  static constexpr std::size_t kBytesKept = std::size_t{64} << 20;

  struct Unmap {
    std::size_t bytes;
    void operator()(Label* labels) const { ::munmap(labels, bytes); }
  };
  using Piece = std::unique_ptr<Label, Unmap>;
  struct Use {
    Label* labels = nullptr;
    std::uint32_t stamp = 0;
  };

  std::size_t piece_bytes() const { return planes_per_piece_ * capacity_ * sizeof(Label); }
  std::size_t bytes() const { return pieces_.size() * piece_bytes(); }

  bool add(std::int32_t state, const Limits& limits) {
    const bool full = used_ == pieces_.size() * planes_per_piece_;
    if (exhausted_ || (full && !add_piece(limits))) {
      if (!exhausted_) limits.memory_exhausted();
      exhausted_ = true;
      return false;
    }
    if (static_cast<std::size_t>(state) >= by_state_.size())
      by_state_.resize(2 * static_cast<std::size_t>(state) + 1);
    by_state_[state] = {
        pieces_[used_ / planes_per_piece_].get() + used_ % planes_per_piece_ * capacity_, stamp_};
    ++used_;
    return true;
  }

  bool add_piece(const Limits& limits) {
    const std::size_t bytes = piece_bytes();
    if (!limits.memory_allows(bytes)) return false;
    void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) return false;
    pieces_.push_back(Piece(static_cast<Label*>(memory), Unmap{bytes}));
    return true;
  }

  std::size_t capacity_ = 0;  // of a plane
  std::size_t planes_per_piece_ = 1;
  std::vector<Piece> pieces_;
  std::int64_t written_before_ = 0;  // when the pieces were new
  std::size_t used_ = 0;
  std::vector<Use> by_state_;
  std::uint32_t stamp_ = 0;
  bool exhausted_ = false;
};

}  // namespace grove::detail
