// SPDX-License-Identifier: MIT
// Checkpoint options of a run, and the timer that decides when a checkpoint is due.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "model/limits.h"

namespace grove::detail {

// Checkpoint options. A run writes checkpoints every `interval_s` seconds, on request, and at its
// end, whatever ended it.
struct Checkpoints {
  std::filesystem::path directory;  // must exist; empty: no checkpoints
  double interval_s = 600;
  // Request for a checkpoint: a signal handler sets it, the run resets it. nullptr: no requests.
  std::atomic<bool>* asked = nullptr;
};

// Result of writing a checkpoint.
struct CheckpointReport {
  std::int64_t nodes = 0;
  double seconds = 0;   // duration of the write
  std::string failure;  // error message; empty: success
};

// Decides when a checkpoint is due. One thread at a time.
class CheckpointTimer {
 public:
  // Uses the clock of `limits`. Both arguments must outlive this object.
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
  const Checkpoints& checkpoints_;
  const Limits& limits_;
  Limits::Clock::time_point last_;
};

}  // namespace grove::detail
