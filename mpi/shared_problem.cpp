// SPDX-License-Identifier: MIT
#include "mpi/shared_problem.h"

namespace grove::detail {
namespace {

// Bytes. Smaller arrays are not shared, because every host has that much memory and the ranks would
// have to wait for one another.
constexpr std::size_t kMinShared = std::size_t{16} << 20;

}  // namespace

SharedProblem::Need SharedProblem::need(const Instance& instance) {
  const ArrayLayout layout = array_layout(instance);
  const std::size_t bytes = SharedArrays::bytes(layout);
  if (bytes < kMinShared) return {};
  return {bytes, SharedArrays::zero_bytes(layout)};
}

SharedProblem::SharedProblem(const Instance& instance, const Limits& limits, int threads,
                             const SharedMemory& memory) {
  if (!memory.bytes().empty()) {
    arrays_.emplace(memory.bytes(), array_layout(instance), memory.member(), memory.members());
    set_shared_memory_accounting(arrays_->members(), memory.bytes().size());
  }
  problem_.emplace(instance, limits, threads, nullptr, arrays_ ? &*arrays_ : nullptr);
}

SharedProblem::~SharedProblem() {
  set_shared_memory_accounting(1, 0);
}

}  // namespace grove::detail
