// SPDX-License-Identifier: MIT
// How far to go in a direction that promises more.
#pragma once

#include "model/tuning.h"

namespace grove::detail {

// A subgradient method with a target level (Goffin and Kiwiel 1999): steps are those of Polyak
// towards a level some way above the best value so far. The way grows shorter when the level proves
// out of reach. It proves nothing, and whatever it says does no harm. For one thread at a time.
class TargetLevelStep {
 public:
  explicit TargetLevelStep(const Tuning& tuning) : tuning_(tuning) {}

  // The step from a point of this value along a direction of this squared length (> 0). No value
  // will be above `most`.
  double step(double value, double most, double squares);
  // From the best value so far to the level; 0 before the first step.
  double way() const { return way_; }

 private:
  void choose_level(double most);

  const Tuning& tuning_;
  double best_ = 0;
  double best_at_level_ = 0;  // when this level was chosen
  double way_ = 0;
  int waited_ = 0;
};

}  // namespace grove::detail
