// SPDX-License-Identifier: MIT
#include "grove/detail/lagrangian/level_ascent.h"

#include <algorithm>

namespace grove::detail {

double LevelAscent::step(double value, double most, double squares) {
  best_ = std::max(best_, value);
  choose_level(most);
  return std::max(0.0, best_ + way_ - value) / squares;
}

void LevelAscent::choose_level(double most) {
  const double room = std::max(0.0, most - best_);
  if (way_ <= 0) {
    way_ = tuning_.lagrangian_level * best_;
  } else if (best_ < best_at_level_ + tuning_.lagrangian_enough * way_) {
    if (++waited_ < tuning_.lagrangian_patience) return;
    way_ *= tuning_.lagrangian_shrink;
  }
  way_ = std::min(way_, room);
  best_at_level_ = best_;
  waited_ = 0;
}

}  // namespace grove::detail
