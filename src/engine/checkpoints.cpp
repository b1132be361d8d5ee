// SPDX-License-Identifier: MIT
#include "grove/detail/engine/checkpoints.h"

namespace grove::detail {

bool CheckpointTimer::due() {
  if (checkpoints_.directory.empty()) return false;
  const bool asked = checkpoints_.asked && checkpoints_.asked->exchange(false);
  const Clock::time_point now = Clock::now();
  if (!asked && std::chrono::duration<double>(now - last_).count() < checkpoints_.interval_s)
    return false;
  last_ = now;
  return true;
}

}  // namespace grove::detail
