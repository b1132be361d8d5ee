// SPDX-License-Identifier: MIT
#include "engine/checkpoints.h"

#include <chrono>

namespace grove::detail {

bool CheckpointTimer::due() {
  if (checkpoints_.directory.empty()) return false;
  const bool asked = checkpoints_.asked && checkpoints_.asked->exchange(false);
  const Limits::Clock::time_point now = limits_.now();
  if (!asked && std::chrono::duration<double>(now - last_).count() < checkpoints_.interval_s)
    return false;
  last_ = now;
  return true;
}

}  // namespace grove::detail
