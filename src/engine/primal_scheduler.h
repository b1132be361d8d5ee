// SPDX-License-Identifier: MIT
// Divides the work of one worker between the tree search and the primal search.
#pragma once

#include <cstdint>

#include "primal/primal_search.h"

namespace grove::detail {

struct TreeOutlook {
  bool is_dominated = false;  // more is proven outside the tree search than by it
  bool gap_is_large = false;  // the gap exceeds large_gap
};

// Counts work, not seconds, so that a run is repeatable. The rule is at the head of the .cpp. One
// thread at a time.
class PrimalScheduler {
 public:
  PrimalScheduler(int agents, const Tuning& tuning);

  // Adds `work` units of tree work, in the units of PrimalSearch::work().
  void add_tree_work(std::int64_t work, TreeOutlook outlook = {});
  // True once the tree has done enough work (kPrimalStartWork).
  bool may_begin() const;
  // True if the next work item is the primal search's.
  bool due(const PrimalSearch& primal) const;
  void add_primal_work(const PrimalSearch& primal, std::int64_t work);

 private:
  double ratio_with_plan(const PrimalSearch& primal) const;
  double max_ratio(bool gap_is_large) const;

  const std::int64_t agents_;
  const Tuning tuning_;
  std::int64_t tree_ = 0;
  double credit_ = 0;  // work that the primal search may do now
  double ratio_;       // primal work per unit of tree work, before floor and cap
};

}  // namespace grove::detail
