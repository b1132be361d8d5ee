// SPDX-License-Identifier: MIT
// Open list of the low level: a bucket queue.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "model/assert.h"
#include "model/grid.h"

namespace grove::detail {

// A monotone priority queue for small integers. Entries are popped in ascending order of *layer*
// (an f value), then of conflicts. Ties in the current layer are popped last in, first out, which
// favours depth; ties that were pushed for a later layer are popped in no specified order. push()
// is amortized O(1). So is pop(), except for skipping empty lists and for each move of the window,
// which visits all later entries.
//
// Entries are stored in one pool and linked into lists: one per conflict count for the current
// layer, one per layer of a window of kWindow layers, one for all later layers. The pool keeps its
// memory, so only a search that is larger than all earlier ones allocates.
//
// `Progress` is an integer that identifies the set of visited goals. One byte suffices if the order
// of the goals is fixed.
template <class Progress>
class BasicBucketQueue {
 public:
  struct Entry {
    std::int32_t slot = 0;
    Time time = 0;
    std::uint16_t conflicts = 0;  // at most kMaxConflicts
    Progress progress = 0;
  };
  static constexpr std::uint16_t kMaxConflicts = 1023;

  BasicBucketQueue() {
    current_.fill(kNone);
    window_.fill(kNone);
  }

  // Empties the queue. Layers before `first` must not be used.
  void reset(Time first);
  // `layer` must not be before layer().
  void push(Time layer, const Entry& entry);
  // Removes the next entry. Returns false if the queue is empty.
  bool pop(Entry& entry);
  // The layer of the entry popped last; after reset(), `first`.
  Time layer() const { return layer_; }

 private:
  static constexpr std::int32_t kNone = -1;
  static constexpr Time kWindow = 1024;

  struct Node {
    Entry entry;
    Time layer;
    std::int32_t next;
  };

  void chain(std::int32_t& head, std::int32_t node) {
    pool_[node].next = head;
    head = node;
  }
  void place(std::int32_t node);
  void place_all(std::int32_t& head);
  bool next_layer();
  bool move_window();

  Time layer_ = 0;
  Time window_begin_ = 0;
  Time window_used_ = 0;  // lists of window_ from this one on are empty
  int level_ = 0;         // lists of current_ before this one are empty
  int levels_used_ = 0;   // lists of current_ from this one on are empty
  std::array<std::int32_t, kMaxConflicts + 1> current_;  // heads by conflicts
  std::array<std::int32_t, kWindow> window_;             // heads by layer - window_begin_
  std::int32_t beyond_ = kNone;
  std::vector<Node> pool_;
};

using BucketQueue = BasicBucketQueue<std::uint8_t>;

template <class Progress>
inline void BasicBucketQueue<Progress>::reset(Time first) {
  std::fill_n(current_.begin(), levels_used_, kNone);
  std::fill_n(window_.begin(), window_used_, kNone);
  beyond_ = kNone;
  pool_.clear();
  layer_ = window_begin_ = first;
  window_used_ = 0;
  level_ = levels_used_ = 0;
}

template <class Progress>
inline void BasicBucketQueue<Progress>::push(Time layer, const Entry& entry) {
  GROVE_ASSERT(layer >= layer_, "layers never decrease");
  GROVE_ASSERT(entry.conflicts <= kMaxConflicts, "the number of conflicts is at most its maximum");
  pool_.push_back({entry, layer, kNone});
  place(static_cast<std::int32_t>(pool_.size() - 1));
}

template <class Progress>
inline void BasicBucketQueue<Progress>::place(std::int32_t node) {
  const Node& n = pool_[node];
  if (n.layer == layer_) {
    chain(current_[n.entry.conflicts], node);
    level_ = std::min<int>(level_, n.entry.conflicts);
    levels_used_ = std::max(levels_used_, n.entry.conflicts + 1);
  } else if (n.layer - window_begin_ < kWindow) {
    chain(window_[n.layer - window_begin_], node);
    window_used_ = std::max(window_used_, n.layer - window_begin_ + 1);
  } else {
    chain(beyond_, node);
  }
}

template <class Progress>
inline bool BasicBucketQueue<Progress>::pop(Entry& entry) {
  for (;;) {
    for (; level_ < levels_used_; ++level_) {
      const std::int32_t node = current_[level_];
      if (node == kNone) continue;
      GROVE_ASSERT(pool_[node].layer == layer_ && pool_[node].entry.conflicts == level_,
                   "an entry is popped in its layer, by its number of conflicts");
      current_[level_] = pool_[node].next;
      entry = pool_[node].entry;
      return true;
    }
    if (!next_layer()) return false;
  }
}

template <class Progress>
inline void BasicBucketQueue<Progress>::place_all(std::int32_t& head) {
  std::int32_t node = head;
  head = kNone;
  while (node != kNone) {
    const std::int32_t next = pool_[node].next;
    place(node);
    node = next;
  }
}

template <class Progress>
inline bool BasicBucketQueue<Progress>::next_layer() {
  level_ = levels_used_ = 0;
  for (Time offset = layer_ - window_begin_; offset < window_used_; ++offset) {
    if (window_[offset] == kNone) continue;
    layer_ = window_begin_ + offset;
    place_all(window_[offset]);
    return true;
  }
  return move_window();
}

// Moves the window, which is empty, to the first layer after it. Returns false if there is none.
template <class Progress>
inline bool BasicBucketQueue<Progress>::move_window() {
  if (beyond_ == kNone) return false;
  Time first = kNever;
  for (std::int32_t node = beyond_; node != kNone; node = pool_[node].next)
    first = std::min(first, pool_[node].layer);
  GROVE_ASSERT(first > layer_, "the layers after the window are later than the current one");
  layer_ = window_begin_ = first;
  window_used_ = 0;
  place_all(beyond_);
  return true;
}

}  // namespace grove::detail
