// SPDX-License-Identifier: MIT
#include "tools/solve/disk_flusher.h"

#include <fmt/format.h>

#include <utility>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "tools/common/standard_error.h"

namespace grove::detail {

DiskFlusher::~DiskFlusher() {
  {
    const std::lock_guard guard(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void DiskFlusher::flush(const std::filesystem::path& file) {
  {
    const std::lock_guard guard(mutex_);
    waiting_.insert(file);
  }
  wake_.notify_one();
}

void DiskFlusher::run() {
  bool failed = false;
  std::unique_lock guard(mutex_);
  while (true) {
    wake_.wait(guard, [this] { return stopping_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const auto file = waiting_.extract(waiting_.begin());
    guard.unlock();
    try {
      flush_file(file.value());
    } catch (const InputError& error) {
      if (!std::exchange(failed, true))
        print_to_stderr(
            fmt::format("grove: warning: {}; a crash of the machine may lose plans", error.what()));
    }
    guard.lock();
  }
}

}  // namespace grove::detail
