// SPDX-License-Identifier: MIT
// How a run keeps within its memory: how much nodes may hold, and how much what the expanders know.
#pragma once

#include <cstddef>

#include "model/limits.h"

namespace grove::detail {

// Budgets for what the search can give up. Of one thread; the rule is at the head of the .cpp.
class MemoryBudgets {
 public:
  // `limits` must outlive this. `most_for_nodes`: their budget from the beginning.
  MemoryBudgets(const Limits& limits, std::size_t most_for_nodes);

  // Is the process near its limit, for all that the budgets in force do?
  bool is_short() const {  // the last look may be older than the last cut
    return limits_.last_resident() > alarm_ && resident_bytes() > alarm_;
  }
  // Cuts the budgets, given what is held now. The caller makes both obey, gives back to the system
  // what can be given back, and calls settled().
  void cut(std::size_t nodes_hold, std::size_t expanders_hold);
  void settled();

  // In bytes.
  std::size_t for_nodes() const { return for_nodes_; }
  std::size_t for_expanders() const { return for_expanders_; }

 private:
  const Limits& limits_;
  std::size_t alarm_;
  std::size_t for_nodes_;
  std::size_t for_expanders_;
};

}  // namespace grove::detail
