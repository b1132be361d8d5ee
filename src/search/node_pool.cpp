// SPDX-License-Identifier: MIT
#include "grove/search/node_pool.h"

namespace grove {

void* NodePool::allocate(std::size_t bytes) {
  void* memory = memory_.allocate(bytes);
  bytes_.fetch_add(bytes, std::memory_order_relaxed);
  return memory;
}

void NodePool::release(void* memory, std::size_t bytes) {
  memory_.deallocate(memory, bytes);
  bytes_.fetch_sub(bytes, std::memory_order_relaxed);
}

}  // namespace grove
