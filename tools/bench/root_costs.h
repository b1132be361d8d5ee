// SPDX-License-Identifier: MIT
// What the first roots of instances cost, worked out once each.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail::bench {

// Of any thread: whoever asks first for an instance does the work, others for the same one wait.
class RootCosts {
 public:
  // Of so many instances; each may take `seconds` and let the process grow to `bytes`.
  RootCosts(std::size_t instances, double seconds, std::size_t bytes);

  // sum_of_best_sequences() of `instance`, which is number `index`; none when there is no way for
  // some agent, or when it took too long.
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
