// SPDX-License-Identifier: MIT
// Sparse storage for the labels of a search that reaches only few of many possible stages.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "model/assert.h"
#include "model/limits.h"

namespace grove::detail {

// Holds one *plane* of labels, indexed by slot, for each "state" that a search reaches; a state
// here is a progress or stage, not a state of a World. Planes are allocated on demand and reused by
// later searches. No label is cleared, because a label of an earlier search has an earlier stamp.
// On a large map a plane occupies only the memory pages in which a label was accessed.
// begin_search() releases the memory if earlier searches have used many pages or the planes are too
// small. `Label` is any trivial type with a member `stamp`, which the search must set together with
// the other members. One thread at a time.
template <class Label>
requires std::is_trivial_v<Label> && std::same_as<decltype(Label::stamp), std::uint32_t>
class LabelPlanes {
 public:
  // Discards all labels. `slots`: number of slots in the next search.
  void begin_search(int slots) {
    if (touched_groups_ > kGroupsKept) release_memory();
    if (static_cast<std::size_t>(slots) > capacity_) {
      release_memory();
      // At first the spare capacity is small, because memory may be short. Later the capacity grows
      // by half, because with reservations the number of slots grows with each path.
      const std::size_t tight =
          static_cast<std::size_t>(slots) + static_cast<std::size_t>(slots) / 8 + kSpare;
      capacity_ = std::max(tight, capacity_ + capacity_ / 2);
      planes_per_piece_ =
          std::clamp<std::size_t>(kPieceBytes / (capacity_ * sizeof(Label)), 1, kMaxPlanesPerPiece);
    }
    if (++stamp_ == 0) {
      release_memory();
      by_state_.clear();
      stamp_ = 1;
    }
    used_ = 0;
    exhausted_ = false;
  }

  // Ensures that the state has a plane. Returns false, and exhausted() becomes true, if the memory
  // for it is not available.
  bool open(std::int32_t state, const Limits& limits) {
    if (static_cast<std::size_t>(state) < by_state_.size() && by_state_[state].stamp == stamp_)
      return true;
    return add(state, limits);
  }
  bool exhausted() const { return exhausted_; }

  // open() must have returned true for the state in this search.
  Label& label(std::int32_t slot, std::int32_t state) {
    const Use& use = by_state_[state];
    GROVE_ASSERT(use.stamp == stamp_, "the state is open");
    GROVE_ASSERT(slot >= 0 && static_cast<std::size_t>(slot) < capacity_,
                 "a slot is within its plane");
    Label& found = use.labels[slot];
    if (auto& touched = use.touched[slot / kGroup]; !touched) {
      touched = true;
      ++touched_groups_;
      found.stamp = 0;
    }
    return found;
  }
  bool is_current(const Label& label) const { return label.stamp == stamp_; }
  std::uint32_t stamp() const { return stamp_; }

 private:
  static constexpr std::size_t kSpare = 64;
  // Number of labels on about one page. The first access to a page is a write. A page that is read
  // first is mapped to the shared page of zeros, so that its first write faults a second time and
  // interrupts all threads.
  static constexpr std::int32_t kGroup = 4096 / sizeof(Label);
  // Memory is allocated in pieces of one or more planes, with mmap, because an allocator would have
  // to clear memory that it reuses.
  static constexpr std::size_t kPieceBytes = std::size_t{16} << 20;
  static constexpr std::size_t kMaxPlanesPerPiece = 16;
  // Number of accessed groups above which the next search releases the memory. A label that is the
  // only one on its page costs two hundred times its size.
  static constexpr std::int64_t kGroupsKept = (std::int64_t{128} << 20) / 4096;

  struct Unmap {
    std::size_t bytes;
    void operator()(Label* labels) const { ::munmap(labels, bytes); }
  };
  struct Piece {
    std::unique_ptr<Label, Unmap> labels;
    std::vector<std::uint8_t> touched;  // by plane, then group: 1 if a label of it was accessed
  };
  // The plane of a state in the search with this stamp.
  struct Use {
    Label* labels = nullptr;
    std::uint8_t* touched = nullptr;
    std::uint32_t stamp = 0;
  };

  std::size_t groups() const { return capacity_ / kGroup + 1; }
  std::size_t piece_bytes() const { return planes_per_piece_ * capacity_ * sizeof(Label); }

  void release_memory() {
    pieces_.clear();
    touched_groups_ = 0;
  }

  bool add(std::int32_t state, const Limits& limits) {
    const bool full = used_ == pieces_.size() * planes_per_piece_;
    if (exhausted_ || (full && !add_piece(limits))) {
      if (!exhausted_) limits.memory_exhausted();
      exhausted_ = true;
      return false;
    }
    if (static_cast<std::size_t>(state) >= by_state_.size())
      by_state_.resize(2 * static_cast<std::size_t>(state) + 1);
    GROVE_ASSERT(by_state_[state].stamp != stamp_, "a state has one plane in a search");
    Piece& piece = pieces_[used_ / planes_per_piece_];
    const std::size_t plane = used_++ % planes_per_piece_;
    by_state_[state] = {piece.labels.get() + plane * capacity_,
                        piece.touched.data() + plane * groups(), stamp_};
    return true;
  }

  bool add_piece(const Limits& limits) {
    const std::size_t bytes = piece_bytes();
    if (!limits.memory_allows(bytes)) return false;
    void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) return false;
    pieces_.push_back({{static_cast<Label*>(memory), Unmap{bytes}},
                       std::vector<std::uint8_t>(planes_per_piece_ * groups())});
    return true;
  }

  std::size_t capacity_ = 0;  // slots per plane
  std::size_t planes_per_piece_ = 1;
  std::vector<Piece> pieces_;
  std::int64_t touched_groups_ = 0;
  std::size_t used_ = 0;
  std::vector<Use> by_state_;
  std::uint32_t stamp_ = 0;
  bool exhausted_ = false;
};

}  // namespace grove::detail
