// SPDX-License-Identifier: MIT
#include "search/node_pool.h"

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 18;

}  // namespace

void* NodePool::allocate(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  void* memory =
      bytes > kMaxSmallBytes ? large_.allocate(bytes) : take_small((bytes + kStep - 1) / kStep);
  bytes_ += bytes;
  ++made_;
  made_bytes_ += bytes;
  return memory;
}

// If the rest of a chunk is too small for the next node, it is lost: less than 1 %.
void* NodePool::take_small(std::size_t size_class) {
  if (Free* block = free_[size_class]) {
    free_[size_class] = block->next;
    return block;
  }
  const std::size_t size = size_class * kStep;
  if (size > rest_bytes_) {
    chunks_.push_back(std::make_unique_for_overwrite<std::byte[]>(kChunk));
    rest_ = chunks_.back().get();
    rest_bytes_ = kChunk;
  }
  std::byte* memory = rest_;
  rest_ += size;
  rest_bytes_ -= size;
  return memory;
}

void NodePool::release(void* memory, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  GROVE_ASSERT(bytes <= bytes_, "a pool releases no more bytes than it has allocated");
  bytes_ -= bytes;
  if (bytes > kMaxSmallBytes) return large_.deallocate(memory, bytes);
  Free*& head = free_[(bytes + kStep - 1) / kStep];
  head = new (memory) Free{head};
}

std::size_t NodePool::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

double NodePool::mean_bytes() const {
  const std::lock_guard lock(mutex_);
  return made_ == 0 ? 0 : static_cast<double>(made_bytes_) / static_cast<double>(made_);
}

}  // namespace grove::detail
