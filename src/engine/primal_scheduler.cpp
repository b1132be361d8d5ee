// SPDX-License-Identifier: MIT
// Divides the effort of a worker between tree search and primal search. For each unit of tree work
// the primal search may do r units, 1/32 <= r <= 8, from when the tree has done tree_begins_work:
// - With a plan, r = 8 x^3, where x = (primal work at its last improvement) / (primal work so far):
//   x = 1 right after an improvement, 1/2 when as much work again brought none. So r = 8, 1, 1/8 at
//   x = 1, 1/2, 1/4.
// - Without a plan, r = 8: without an incumbent nothing is pruned, and a run that ends has nothing
//   to show. After two failed attempts per agent r = 1: the instance may have no plan. While the
//   primal search expects a plan soon it gets all work, not counted here, because expanding the
//   root of a large instance can take seconds.
// - Floor, below the cap: r >= 1 while more is proven outside the tree search than by it (then tree
//   work raises no bound) or the gap exceeds far_plan (no tree closes it soon): neighbourhoods may
//   fail a hundred times before the first of many gains.
// - Cap: r <= clamp(8 t, 1/4, 8), t = (tree work) / tree_is_long_work, because the tree closes most
//   small instances within tenths of a second, whatever plan there is. While the gap exceeds
//   far_plan the cap is 8 at once.
// r depends neither on the size of the instance nor on the speed of the machine. The numbers are
// the defaults of tunables.def.
#include "engine/primal_scheduler.h"

#include <algorithm>

namespace grove::detail {
PrimalScheduler::PrimalScheduler(int agents, const Tuning& tuning)
    : agents_(agents), tuning_(tuning), ratio_(tuning.most_primal) {}

void PrimalScheduler::add_tree_work(std::int64_t work, TreeOutlook outlook) {
  tree_ += work;
  const bool beside = outlook.is_behind || outlook.gap_is_large;
  const double ratio = beside ? std::max(ratio_, tuning_.least_primal_beside) : ratio_;
  credit_ += std::min(ratio, most_ratio(outlook.gap_is_large)) * static_cast<double>(work);
}

bool PrimalScheduler::may_begin() const {
  return tree_ >= tuning_.tree_begins_work;
}

bool PrimalScheduler::due(const PrimalSearch& primal) const {
  return primal.expects_plan() || (!primal.optimal() && credit_ >= 0);
}

void PrimalScheduler::add_primal_work(const PrimalSearch& primal, std::int64_t work) {
  if (primal.best_cost())
    ratio_ = ratio_with_plan(primal);
  else
    ratio_ = primal.counts().attempts <= tuning_.attempts_before_doubt * agents_
                 ? tuning_.most_primal
                 : tuning_.primal_in_doubt;
  if (primal.expects_plan()) return;
  credit_ = std::max(0.0, credit_);
  credit_ -= static_cast<double>(work);
}

double PrimalScheduler::ratio_with_plan(const PrimalSearch& primal) const {
  const double x =
      static_cast<double>(primal.work_at_last_plan()) / static_cast<double>(primal.work());
  return std::clamp(tuning_.most_primal * x * x * x, tuning_.least_primal, tuning_.most_primal);
}

double PrimalScheduler::most_ratio(bool gap_is_large) const {
  if (gap_is_large) return tuning_.most_primal;
  const double part = static_cast<double>(tree_) / static_cast<double>(tuning_.tree_is_long_work);
  return std::clamp(tuning_.most_primal * part, tuning_.most_primal_at_first, tuning_.most_primal);
}

}  // namespace grove::detail
