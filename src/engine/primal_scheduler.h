// SPDX-License-Identifier: MIT
// How one thread divides its work between the tree and the primal search.
#pragma once

#include <cstdint>

#include "primal/primal_search.h"

namespace grove::detail {

struct TreeOutlook {
  bool is_behind = false;     // more is proven beside the tree than by it
  bool gap_is_large = false;  // the best plan costs much more than what is proven
};

// Counts work, not seconds, so that a run can be repeated. The rule is at the head of the .cpp.
class PrimalScheduler {
 public:
  PrimalScheduler(int agents, const Tuning& tuning);

  // The tree has done so much more work, in the units of PrimalSearch::work().
  void add_tree_work(std::int64_t work, TreeOutlook outlook = {});
  // Has the tree done enough for the primal search to begin?
  bool may_begin() const;
  // Is it the turn of the primal search?
  bool due(const PrimalSearch& primal) const;
  void add_primal_work(const PrimalSearch& primal, std::int64_t work);

 private:
  double ratio_with_plan(const PrimalSearch& primal) const;
  double most_ratio(bool gap_is_large) const;

  const std::int64_t agents_;
  const Tuning tuning_;
  std::int64_t tree_ = 0;
  double credit_ = 0;  // work that the primal search may do at once
  double ratio_;       // and for each unit that the tree does
};

}  // namespace grove::detail
