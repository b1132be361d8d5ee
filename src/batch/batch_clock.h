// SPDX-License-Identifier: MIT
// The two clocks of a batch: elapsed seconds and UTC.
#pragma once

#include <functional>
#include <string>

namespace grove::detail::batch {

struct BatchClock {
  std::function<double()> seconds;   // elapsed since some fixed moment; monotonic
  std::function<std::string()> utc;  // current time, such as 2026-11-30T23:59:59Z
};

// The clocks of the machine.
BatchClock machine_clock();

}  // namespace grove::detail::batch
