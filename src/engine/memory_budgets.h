// SPDX-License-Identifier: MIT
// Memory budgets of a run: for nodes and for the expanders' caches.
#pragma once

#include <cstddef>

#include "model/limits.h"

namespace grove::detail {

// Budgets for the memory that the search can evict. One thread at a time. The rule is at the head
// of the .cpp.
class MemoryBudgets {
 public:
  // `limits` must outlive this. `most_for_nodes`: initial budget for nodes, in bytes.
  MemoryBudgets(const Limits& limits, std::size_t most_for_nodes);

  // True if the process is near its limit despite the current budgets.
  bool is_short() const {  // last_resident() may be older than the last cut
    return limits_.last_resident() > alarm_ && resident_bytes() > alarm_;
  }
  // Cuts the budgets, given the bytes held now. The caller then evicts down to both budgets,
  // returns free memory to the system, and calls settled().
  void cut(std::size_t nodes_hold, std::size_t expanders_hold);
  void settled();

  // Budgets in bytes.
  std::size_t for_nodes() const { return for_nodes_; }
  std::size_t for_expanders() const { return for_expanders_; }

 private:
  const Limits& limits_;
  std::size_t alarm_;
  std::size_t for_nodes_;
  std::size_t for_expanders_;
};

}  // namespace grove::detail
