// SPDX-License-Identifier: MIT
// The open list of a joint search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/assert.h"
#include "model/plan.h"

namespace grove::detail {

// States by layer. Layers are emptied in ascending order. Within a layer, the state pushed last is
// popped first. One thread at a time.
class LayerQueue {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = ~Index{0};

  // No state may be pushed to a layer below `first`.
  explicit LayerQueue(Cost first = 0) : first_(first), layer_(first) {}

  // The layer that is being emptied: no state in the queue has a lower one. kInfiniteCost once
  // pop() has found the queue empty.
  Cost layer() const { return layer_; }
  // Bytes of the states in the queue.
  std::size_t bytes() const { return queued_ * sizeof(Index); }

  void push(Index state, Cost layer) {
    GROVE_ASSERT(layer >= layer_, "no state is pushed to a layer below the current one");
    const auto at = static_cast<std::size_t>(layer - first_);
    if (at >= layers_.size()) layers_.resize(at + 1);
    layers_[at].push_back(state);
    ++queued_;
  }

  // Takes a state from the least layer. Drops states for which is_in(state, layer) is false,
  // because they are now in a different layer. Returns kNone if no state is left.
  template <class IsIn>
  Index pop(IsIn is_in) {
    for (; at_ < layers_.size(); ++at_, ++layer_) {
      std::vector<Index>& layer = layers_[at_];
      while (!layer.empty()) {
        const Index state = layer.back();
        layer.pop_back();
        --queued_;
        if (is_in(state, layer_)) return state;
      }
      std::vector<Index>().swap(layer);
    }
    GROVE_ASSERT(queued_ == 0, "a queue whose layers are empty holds no states");
    layer_ = kInfiniteCost;
    return kNone;
  }

 private:
  std::vector<std::vector<Index>> layers_;  // from layer first_ on
  std::size_t at_ = 0;                      // position of layer_ in layers_
  std::size_t queued_ = 0;
  Cost first_;
  Cost layer_;
};

}  // namespace grove::detail
