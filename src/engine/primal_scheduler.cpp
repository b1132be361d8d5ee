// SPDX-License-Identifier: MIT
// Divides the effort of a worker between tree search and primal search. Once the tree search has
// spent kPrimalStartWork, the primal search may spend r units per unit of tree effort, 1/32 <= r <=
// 8:
// - With a plan, r = 8 x^3, where x = (primal effort at the last improvement) / (primal effort so
//   far). x is 1 right after an improvement, and 1/2 when the same effort again brought none. For x
//   = 1, 1/2, 1/4, r is 8, 1, 1/8.
// - Without a plan, r = 8, because without an incumbent nothing is pruned, and a run that reaches a
//   limit has no result. After two failed attempts per agent r = 1, because the instance may have
//   no plan. While the primal search expects a plan soon, it gets all effort, which is not counted
//   here, because expanding the root of a large instance can take seconds.
// - Floor (the cap has precedence): r >= 1 while the bound proven outside the tree search exceeds
//   the tree's bound, because then tree effort does not raise the lower bound, and while the gap
//   exceeds large_gap, because then the tree search does not close the gap soon. Without the floor
//   r could fall too low, since neighbourhoods can fail a hundred times before the first of many
//   gains.
// - Cap: r <= clamp(8 t, 1/4, 8), where t = (tree effort) / primal_full_share_work, because the
//   tree search solves most small instances within tenths of a second, whatever the incumbent.
//   While the gap exceeds large_gap, the cap is 8.
// r depends neither on the size of the instance nor on the speed of the machine. The numbers are
// the constants below and the defaults of tunables.def.
#include "engine/primal_scheduler.h"

#include <algorithm>

namespace grove::detail {
namespace {

constexpr std::int64_t kPrimalStartWork = 2000;  // tree effort before the primal search starts
constexpr double kMaxPrimalShare = 8;            // maximum of r
constexpr double kMinPrimalShare = 1.0 / 32;     // minimum of r
// Failed attempts of prioritised planning per agent after which r falls.
constexpr std::int64_t kFailedAttemptsBeforeFallback = 2;

}  // namespace
PrimalScheduler::PrimalScheduler(int agents, const Tuning& tuning)
    : agents_(agents), tuning_(tuning), ratio_(kMaxPrimalShare) {}

void PrimalScheduler::add_tree_work(std::int64_t work, TreeOutlook outlook) {
  tree_ += work;
  const bool beside = outlook.is_dominated || outlook.gap_is_large;
  const double ratio = beside ? std::max(ratio_, tuning_.primal_min_share_dominated) : ratio_;
  credit_ += std::min(ratio, max_ratio(outlook.gap_is_large)) * static_cast<double>(work);
}

bool PrimalScheduler::may_begin() const {
  return tree_ >= kPrimalStartWork;
}

bool PrimalScheduler::due(const PrimalSearch& primal) const {
  return primal.expects_plan() || (!primal.optimal() && credit_ >= 0);
}

void PrimalScheduler::add_primal_work(const PrimalSearch& primal, std::int64_t work) {
  if (primal.best_cost())
    ratio_ = ratio_with_plan(primal);
  else
    ratio_ = primal.counts().attempts <= kFailedAttemptsBeforeFallback * agents_
                 ? kMaxPrimalShare
                 : tuning_.primal_share_after_failures;
  if (primal.expects_plan()) return;
  credit_ = std::max(0.0, credit_);
  credit_ -= static_cast<double>(work);
}

double PrimalScheduler::ratio_with_plan(const PrimalSearch& primal) const {
  const double x =
      static_cast<double>(primal.work_at_last_plan()) / static_cast<double>(primal.work());
  return std::clamp(kMaxPrimalShare * x * x * x, kMinPrimalShare, kMaxPrimalShare);
}

double PrimalScheduler::max_ratio(bool gap_is_large) const {
  if (gap_is_large) return kMaxPrimalShare;
  const double part =
      static_cast<double>(tree_) / static_cast<double>(tuning_.primal_full_share_work);
  return std::clamp(kMaxPrimalShare * part, tuning_.primal_max_share_initial, kMaxPrimalShare);
}

}  // namespace grove::detail
