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
// until the tree has done a thirty-second of kTreeIsLong_work, and 8 when it has done all. None of
// this knows how large the instance is or how fast the machine.
#include "primal_share.h"

#include <algorithm>

namespace grove {
namespace {

constexpr std::int64_t kTreeBegins_work = 2000;
constexpr std::int64_t kTreeIsLong_work = 6'400'000;
constexpr double kMostRatio = 8;
constexpr double kMostRatioAtFirst = 1.0 / 4;
constexpr double kRatioInDoubt = 1;
constexpr double kLeastRatio = 1.0 / 32;
constexpr std::int64_t kAttemptsPerAgent = 2;

double ratio_with_plan(const PrimalSearch& primal) {
  const double x =
      static_cast<double>(primal.work_at_last_plan()) / static_cast<double>(primal.work());
  return std::clamp(kMostRatio * x * x * x, kLeastRatio, kMostRatio);
}

double most_ratio_after(std::int64_t tree_work) {
  const double part = static_cast<double>(tree_work) / static_cast<double>(kTreeIsLong_work);
  return std::clamp(kMostRatio * part, kMostRatioAtFirst, kMostRatio);
}

}  // namespace

PrimalShare::PrimalShare(int agents) : agents_(agents), ratio_(kMostRatio) {}

void PrimalShare::tree_worked(std::int64_t work) {
  tree_ += work;
  credit_ += std::min(ratio_, most_ratio_after(tree_)) * static_cast<double>(work);
}

bool PrimalShare::may_begin() const {
  return tree_ >= kTreeBegins_work;
}

bool PrimalShare::due(const PrimalSearch& primal) const {
  return primal.expects_plan() || (!primal.optimal() && credit_ >= 0);
}

void PrimalShare::primal_worked(const PrimalSearch& primal, std::int64_t work) {
  if (primal.best_cost())
    ratio_ = ratio_with_plan(primal);
  else
    ratio_ = primal.counts().attempts <= kAttemptsPerAgent * agents_ ? kMostRatio : kRatioInDoubt;
  if (primal.expects_plan()) return;
  credit_ = std::max(0.0, credit_);
  credit_ -= static_cast<double>(work);
}

}  // namespace grove
