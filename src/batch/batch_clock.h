// SPDX-License-Identifier: MIT
// The two clocks of a batch.
#pragma once

#include <functional>
#include <string>

namespace grove::detail::batch {

struct BatchClock {
  std::function<double()> seconds;   // since some moment; never goes back
  std::function<std::string()> utc;  // as 2026-11-30T23:59:59Z
};

// Those of the machine.
BatchClock machine_clock();

}  // namespace grove::detail::batch
