// SPDX-License-Identifier: MIT
// Checkpoint options of a run, and the timer.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "model/limits.h"

namespace grove::detail {

// Checkpoints are written every `interval_s` seconds, on request, and at the end of the run,
// whatever ended it. A value.
struct Checkpoints {
  std::filesystem::path directory;  // must exist; empty: no checkpoints
  double interval_s = 600;
  std::atomic<bool>* asked = nullptr;  // set by a signal handler, reset by the run; may be null
};

// Outcome of writing a checkpoint.
struct CheckpointReport {
  std::int64_t nodes = 0;
  double seconds = 0;   // duration of the write
  std::string failure;  // error message; empty: success
};

// Decides when a checkpoint is due. One thread at a time.
class CheckpointTimer {
 public:
  // Uses the clock of `limits`.
  CheckpointTimer(const Checkpoints& checkpoints, const Limits& limits)
      : checkpoints_(checkpoints), limits_(limits), last_(limits.now()) {}

  // Returns true if a checkpoint is due, and then restarts the interval.
  bool due() {
    if (checkpoints_.directory.empty()) return false;
    const bool asked = checkpoints_.asked && checkpoints_.asked->exchange(false);
    const Limits::Clock::time_point now = limits_.now();
    if (!asked && std::chrono::duration<double>(now - last_).count() < checkpoints_.interval_s)
      return false;
    last_ = now;
    return true;
  }

 private:
  const Checkpoints& checkpoints_;  // both owned by the caller
  const Limits& limits_;
  Limits::Clock::time_point last_;
};

}  // namespace grove::detail
