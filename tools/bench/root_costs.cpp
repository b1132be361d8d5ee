// SPDX-License-Identifier: MIT
#include "tools/bench/root_costs.h"

#include <chrono>

#include "sequencing/sum_of_best_sequences.h"

namespace grove::detail::bench {

RootCosts::RootCosts(std::size_t instances, double seconds, std::size_t bytes)
    : known_(instances), seconds_(seconds), bytes_(bytes) {}

std::optional<Cost> RootCosts::of(std::size_t index, const Instance& instance) {
  Known& known = known_[index];
  std::call_once(known.once, [&] {
    Limits limits;
    limits.set_deadline(Limits::Clock::now() + std::chrono::duration_cast<Limits::Clock::duration>(
                                                   std::chrono::duration<double>(seconds_)));
    limits.set_memory_limit(bytes_);
    known.cost = sum_of_best_sequences(instance, limits);
    if (known.cost == kInfiniteCost) known.cost.reset();
  });
  return known.cost;
}

}  // namespace grove::detail::bench
