// SPDX-License-Identifier: MIT
// Problem: the memory limit is on the resident set, but the resident set is no usable control
// variable. Memory that evicted nodes free is used for the next nodes and never returns to the
// system, so a search that evicted until the resident set fell would evict everything.
//
// Solution: measure two things. The resident set decides when memory is short: when 7/8 of the room
// at the start are used. The memory that the search can evict, by its own account, is then taken as
// the amount that fits. From then on nodes may hold half of it and the expanders' caches three
// eighths, because their arrays double as they grow. The resident set should now stay where it is.
// If it still rises, because other parts grow or small blocks are fragmented, the next alarm is
// half way to the limit, and the budgets are cut again. Each cut takes an eighth and halves the
// room, so there are few cuts. If this does not suffice, the limit stops the run.
#include "engine/memory_budgets.h"

#include <algorithm>
#include <limits>

namespace grove::detail {
namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kLeast = 64 << 10;  // bytes; smaller budgets gain nothing

// Bytes left below `limit`.
std::size_t room(std::size_t limit) {
  return limit - std::min(limit, resident_bytes());
}

}  // namespace

MemoryBudgets::MemoryBudgets(const Limits& limits, std::size_t most_for_nodes)
    : limits_(limits), alarm_(kNoLimit), for_nodes_(most_for_nodes), for_expanders_(kNoLimit) {
  if (const auto limit = limits.memory_limit()) alarm_ = *limit - room(*limit) / 8;
}

void MemoryBudgets::cut(std::size_t nodes_hold, std::size_t expanders_hold) {
  const std::size_t held =
      std::min(nodes_hold, for_nodes_) + std::min(expanders_hold, for_expanders_);
  for_nodes_ = std::min(for_nodes_, std::max(kLeast, held / 2));
  for_expanders_ = std::min(for_expanders_, std::max(kLeast, held / 8 * 3));
}

void MemoryBudgets::settled() {
  const std::size_t limit = *limits_.memory_limit();
  alarm_ = std::max(alarm_, limit - room(limit) / 2);
}

}  // namespace grove::detail
