// SPDX-License-Identifier: MIT
// Sparse storage for the labels of a search that reaches few of very many stages.
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

// One *plane* of labels, indexed by slot, for each state (here: progress or stage) that a search
// reaches. Planes are made when first needed and reused from search to search. Nothing is cleared:
// a label of an earlier search has an earlier stamp. Memory to which no label was written is never
// touched, so on a large map a plane costs only the pages that searches have used; when that may be
// much, the memory is released. `Label` is any trivial type with a `stamp`, which the search must
// set when it sets the other members.
template <class Label>
requires std::is_trivial_v<Label> && std::same_as<decltype(Label::stamp), std::uint32_t>
class LabelPlanes {
 public:
  // Forgets all labels.
  void begin_search(int slots) {
    if (touched_groups_ > kGroupsKept) release_memory();
    if (static_cast<std::size_t>(slots) > capacity_) {
      release_memory();
      // Little spare capacity at first, because memory may be short. Later it grows by half,
      // because with reservations the number of slots grows path by path.
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

  // Makes sure that the state has a plane. Returns false, and exhausted() becomes true, if memory
  // is refused.
  bool open(std::int32_t state, const Limits& limits) {
    if (static_cast<std::size_t>(state) < by_state_.size() && by_state_[state].stamp == stamp_)
      return true;
    return add(state, limits);
  }
  bool exhausted() const { return exhausted_; }

  // The state must be open: see open().
  Label& label(std::int32_t slot, std::int32_t state) {
    const Use& use = by_state_[state];
    GROVE_ASSERT(use.stamp == stamp_, "labels are asked for of an open state");
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
  // Number of labels on about one page. A page is written before it is read: a page that is read
  // first is mapped to a page of zeros, and the first write then faults again and interrupts all
  // threads.
  static constexpr std::int32_t kGroup = 4096 / sizeof(Label);
  // Memory is allocated in pieces of one or more planes, with mmap, because the allocator would
  // clear memory that it has used before.
  static constexpr std::size_t kPieceBytes = std::size_t{16} << 20;
  static constexpr std::size_t kMaxPlanesPerPiece = 16;
  // If searches have touched more groups than this, the memory is released. A label that is the
  // only one on its page costs two hundred times its size.
  static constexpr std::int64_t kGroupsKept = (std::int64_t{128} << 20) / 4096;

  struct Unmap {
    std::size_t bytes;
    void operator()(Label* labels) const { ::munmap(labels, bytes); }
  };
  struct Piece {
    std::unique_ptr<Label, Unmap> labels;
    std::vector<std::uint8_t> touched;  // by plane, then group: was any of its labels accessed?
  };
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

  std::size_t capacity_ = 0;  // of a plane
  std::size_t planes_per_piece_ = 1;
  std::vector<Piece> pieces_;
  std::int64_t touched_groups_ = 0;
  std::size_t used_ = 0;
  std::vector<Use> by_state_;
  std::uint32_t stamp_ = 0;
  bool exhausted_ = false;
};

}  // namespace grove::detail
