// SPDX-License-Identifier: MIT
// Root costs of instances (see sum_of_best_sequences()), computed once each.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail::bench {

// Thread-safe. The first caller for an instance computes; others for the same one wait.
class RootCosts {
 public:
  // For `instances` instances. Each computation takes at most `seconds` and may let the process
  // grow to `bytes`.
  RootCosts(std::size_t instances, double seconds, std::size_t bytes);

  // Returns sum_of_best_sequences() of `instance`, which has number `index`. Returns nullopt if
  // some agent has no path or a limit was reached.
  std::optional<Cost> of(std::size_t index, const Instance& instance);

 private:
  struct Known {
    std::once_flag once;
    std::optional<Cost> cost;
  };

  std::deque<Known> known_;
  const double seconds_;
  const std::size_t bytes_;
};

}  // namespace grove::detail::bench
