// SPDX-License-Identifier: MIT
// Text of the limit that was reached, for plan files.
#pragma once

#include <string>

#include "model/limits.h"

namespace grove::detail {

inline std::string stop_text(StopReason reason) {
  switch (reason) {
    case StopReason::kTime:
      return "time limit";
    case StopReason::kMemory:
      return "memory limit";
    case StopReason::kInterrupt:
      return "interrupt";
    case StopReason::kNone:
      break;
  }
  return "";
}

}  // namespace grove::detail
