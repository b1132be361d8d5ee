// SPDX-License-Identifier: MIT
// When a run writes checkpoints, and where.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

#include "model/limits.h"

namespace grove::detail {

// Every so often, when asked, and when the run ends, however it does. A value.
struct Checkpoints {
  std::filesystem::path directory;  // must exist; empty: no checkpoints
  double interval_s = 600;
  std::atomic<bool>* asked = nullptr;  // a signal handler sets it, the run resets it; may be null
};

// What became of one.
struct CheckpointReport {
  std::int64_t nodes = 0;
  double seconds = 0;   // it took
  std::string failure;  // why it could not be written; empty: it was
};

// Tells when one is due. Of one thread, or under a lock.
class CheckpointTimer {
 public:
  // By the clock of `limits`.
  CheckpointTimer(const Checkpoints& checkpoints, const Limits& limits)
      : checkpoints_(checkpoints), limits_(limits), last_(limits.now()) {}

  // Is one due? If so the time to the next begins.
  bool due();

 private:
  const Checkpoints& checkpoints_;  // owned by the caller, as the limits
  const Limits& limits_;
  Limits::Clock::time_point last_;
};

}  // namespace grove::detail
