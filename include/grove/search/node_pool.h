// SPDX-License-Identifier: MIT
// Where constraint-tree nodes live.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory_resource>

namespace grove {

// Memory for nodes: given back node by node while the search runs, and all at once when it ends,
// which spares millions of destructors between a limit and the answer. Must outlive every use of
// its nodes. Any thread may allocate and release.
class NodePool {
 public:
  NodePool() = default;
  NodePool(const NodePool&) = delete;
  NodePool& operator=(const NodePool&) = delete;

  // Throws std::bad_alloc. Memory is aligned for any type.
  void* allocate(std::size_t bytes);
  void release(void* memory, std::size_t bytes);

  // In nodes alive, without the pool's own overhead.
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  std::pmr::synchronized_pool_resource memory_;
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace grove
