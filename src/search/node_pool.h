// SPDX-License-Identifier: MIT
// Memory pool of constraint-tree nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <vector>

namespace grove::detail {

// Allocator of nodes. Memory is released node by node during the search, and all at once when it
// ends. This avoids millions of destructor calls between a limit and the answer. Must outlive every
// use of its nodes. Thread-safe.
//
// Blocks are cut from chunks in steps of 8 bytes, without headers. A released block is reused for
// the next node of its size, because nodes have few different sizes and these do not change over
// time. No memory returns to the system before the pool is destroyed. So after an eviction the
// resident set stays the same while bytes() falls: control memory by bytes().
class NodePool {
 public:
  NodePool() = default;
  NodePool(const NodePool&) = delete;
  NodePool& operator=(const NodePool&) = delete;

  // Throws std::bad_alloc. Memory is aligned to 8 bytes.
  void* allocate(std::size_t bytes);
  void release(void* memory, std::size_t bytes);

  // Bytes of live nodes.
  std::size_t bytes() const;
  // Mean size in bytes of all nodes ever allocated; 0 before the first.
  double mean_bytes() const;

 private:
  static constexpr std::size_t kStep = 8;
  static constexpr std::size_t kMaxSmallBytes = 1024;
  struct Free {
    Free* next;
  };

  void* take_small(std::size_t size_class);

  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<std::byte[]>> chunks_;
  std::byte* rest_ = nullptr;  // of the last chunk
  std::size_t rest_bytes_ = 0;
  std::array<Free*, kMaxSmallBytes / kStep + 1> free_{};  // by size / kStep
  std::pmr::unsynchronized_pool_resource large_;
  std::size_t bytes_ = 0;
  std::uint64_t made_ = 0;
  std::uint64_t made_bytes_ = 0;
};

}  // namespace grove::detail
