// SPDX-License-Identifier: MIT
// Many small instances are closed by the first nodes of the tree, so the tree begins; of a large
// one it makes the root and no more. Then a plan is wanted first of all: without one nothing is
// pruned, and a run that ends has nothing to show; the primal search gets all work while it expects
// one soon, since to expand the root of a large instance can take seconds; then most, until it has
// failed so often that the instance may have no plan at all. With a plan, its share follows its
// success: let x be the part of its work that was done when it last improved the plan. x = 1 just
// then, 1/2 when it has worked as much again for nothing, and so on. For each unit of the tree's
// work it may do 8 x^3: much more than the tree while it improves, as much at x = 1/2, an eighth at
// 1/4; and never less than 1/32. But the tree closes most small instances within its first tenths
// of a second, whatever plan there is, so it grows into that freedom: it may not have more than 1/4
// until the tree has done a thirty-second of tree_is_long_work, and 8 when it has done all. While
// more is proven beside the tree than by it, what it does raises no bound; while the plan costs
// much more than what is proven (far_plan), no tree closes the gap soon. Then the primal search has
// as much as it at least, for neighbourhoods may be in vain a hundred times before the first of
// many gains; and while the plan is that far, 8 at most from the beginning. None of this knows how
// large the instance is or how fast the machine.
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
