// SPDX-License-Identifier: MIT
// Where constraint-tree nodes live.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <vector>

namespace grove::detail {

// Memory for nodes: given back node by node while the search runs, and all at once when it ends,
// which spares millions of destructors between a limit and the answer. Must outlive every use of
// its nodes. Any thread may allocate and release.
//
// Blocks are cut from chunks in steps of 8 bytes, without a header, and what is given back serves
// the next node of its size: the sizes of nodes are few and do not drift. Nothing returns to the
// system before the end, so after an eviction the resident set stays what it was while bytes()
// falls: steer by bytes().
class NodePool {
 public:
  NodePool() = default;
  NodePool(const NodePool&) = delete;
  NodePool& operator=(const NodePool&) = delete;

  // Throws std::bad_alloc. Memory is aligned to 8 bytes.
  void* allocate(std::size_t bytes);
  void release(void* memory, std::size_t bytes);

  // In nodes alive.
  std::size_t bytes() const;
  // Of all nodes ever made; 0 before the first.
  double mean_bytes() const;

 private:
  static constexpr std::size_t kStep = 8;
  static constexpr std::size_t kMostSmall = 1024;
  struct Free {
    Free* next;
  };

  void* take_small(std::size_t size_class);

  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<std::byte[]>> chunks_;
  std::byte* rest_ = nullptr;  // of the last chunk
  std::size_t rest_bytes_ = 0;
  std::array<Free*, kMostSmall / kStep + 1> free_{};  // by size / kStep
  std::pmr::unsynchronized_pool_resource large_;
  std::size_t bytes_ = 0;
  std::uint64_t made_ = 0;
  std::uint64_t made_bytes_ = 0;
};

}  // namespace grove::detail
