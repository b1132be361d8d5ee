// SPDX-License-Identifier: MIT
#include "batch/batch_clock.h"

#include <fmt/chrono.h>

#include <chrono>
#include <ctime>

namespace grove::detail::batch {

BatchClock machine_clock() {
  using Clock = std::chrono::steady_clock;
  return {[] { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); },
          [] { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }};
}

}  // namespace grove::detail::batch
