// SPDX-License-Identifier: MIT
#include "tests/support/failing_new.h"

#include <cstdlib>
#include <new>

namespace grove::detail::testing {

thread_local int allocations_until_failure = -1;

}  // namespace grove::detail::testing

void* operator new(std::size_t size) {
  int& left = grove::detail::testing::allocations_until_failure;
  if (left >= 0 && left-- == 0) throw std::bad_alloc();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
