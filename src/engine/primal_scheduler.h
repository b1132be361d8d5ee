// SPDX-License-Identifier: MIT
// Divides the effort of one worker between tree search and primal search.
#pragma once

#include <cstdint>

#include "primal/primal_search.h"

namespace grove::detail {

struct TreeOutlook {
  bool is_dominated = false;  // the bound proven outside the tree search exceeds the tree's bound
  bool gap_is_large = false;  // the gap exceeds large_gap
};

// Counts effort (model/effort.h), not seconds, so that a run is repeatable. The rule is at the head
// of the .cpp. One thread at a time.
class PrimalScheduler {
 public:
  PrimalScheduler(int agents, const Tuning& tuning);

  // Records `work` units of tree-search effort, in the unit of PrimalSearch::work().
  void add_tree_work(std::int64_t work, TreeOutlook outlook = {});
  // True once the effort of the tree search has reached kPrimalStartWork.
  bool may_begin() const;
  // True if the next work item should be for the primal search.
  bool due(const PrimalSearch& primal) const;
  void add_primal_work(const PrimalSearch& primal, std::int64_t work);

 private:
  double ratio_with_plan(const PrimalSearch& primal) const;
  double max_ratio(bool gap_is_large) const;

  const std::int64_t agents_;
  const Tuning tuning_;
  std::int64_t tree_ = 0;
  double credit_ = 0;  // effort that the primal search may spend now
  double ratio_;       // primal effort per unit of tree effort, before floor and cap
};

}  // namespace grove::detail
