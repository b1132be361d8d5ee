// SPDX-License-Identifier: MIT
// Root costs of instances (see sum_of_best_sequences()), each computed at most once.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail::bench {

// Thread-safe. The first caller for an instance computes its root cost; concurrent callers for the
// same instance wait.
class RootCosts {
 public:
  // `instances`: number of instances. Each computation stops after `seconds` seconds or when the
  // process has `bytes` bytes of resident memory.
  RootCosts(std::size_t instances, double seconds, std::size_t bytes);

  // Returns sum_of_best_sequences() for `instance`. `index`: its position, from 0. Returns nullopt
  // if some agent has no path or a limit was reached.
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
