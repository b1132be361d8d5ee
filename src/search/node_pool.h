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

// Allocator of constraint-tree nodes. During the search nodes are released one by one; when the
// search ends, the pool frees all of them at once. This avoids millions of destructor calls between
// a limit and the answer. The pool must outlive every use of its nodes. Thread-safe.
//
// Small blocks are cut from chunks; their sizes are multiples of 8 bytes and they have no headers.
// A released block is reused only for nodes of its size. This suffices, because nodes have few
// different sizes, and the mix of sizes stays the same over time. Chunks return to the system only
// when the pool is destroyed. After an eviction, therefore, bytes() falls but the resident set does
// not: control memory by bytes().
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
  static constexpr std::size_t kMaxSmallBytes = 1024;  // bytes; larger blocks come from large_
  struct Free {
    Free* next;
  };

  void* take_small(std::size_t size_class);

  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<std::byte[]>> chunks_;
  std::byte* rest_ = nullptr;  // unused part of the last chunk
  std::size_t rest_bytes_ = 0;
  std::array<Free*, kMaxSmallBytes / kStep + 1> free_{};  // by size / kStep
  std::pmr::unsynchronized_pool_resource large_;
  std::size_t bytes_ = 0;
  std::uint64_t made_ = 0;
  std::uint64_t made_bytes_ = 0;
};

}  // namespace grove::detail
