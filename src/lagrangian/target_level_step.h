// SPDX-License-Identifier: MIT
// Step length of the subgradient method: a Polyak step towards a target level.
#pragma once

#include "model/tuning.h"

namespace grove::detail {

// Target level method (Goffin and Kiwiel 1999). The step is a Polyak step towards a level, which is
// level_distance() above the best value so far. level_distance() is reduced if values do not come
// closer to the level for some iterations. The validity of the bound does not depend on the step.
// One thread at a time.
class TargetLevelStep {
 public:
  explicit TargetLevelStep(const Tuning& tuning) : tuning_(tuning) {}

  // The step length from a point with value `value` along a direction with squared norm `squares` >
  // 0. `upper_bound`: upper bound on the level.
  double step(double value, double upper_bound, double squares);
  // The distance from the best value so far to the level; 0 before the first step.
  double level_distance() const { return level_distance_; }

 private:
  void choose_level(double upper_bound);

  const Tuning& tuning_;
  double best_ = 0;
  double best_at_level_ = 0;  // best_ when the level was chosen
  double level_distance_ = 0;
  int waited_ = 0;
};

}  // namespace grove::detail
