// SPDX-License-Identifier: MIT
// Random troubles of robots.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail::testing {

// One schedule: actions that take longer now and then, slower robots, long stops, and with
// `may_die` robots that stop for good. The same seed makes the same one, whenever actions begin.
class Delays {
 public:
  Delays(const ActionDependencyGraph& order, std::uint64_t seed, bool may_die = false);

  Time operator()(ActionIndex action, Time begin);
  bool anybody_dies() const { return dies_; }

 private:
  const ActionDependencyGraph& order_;
  std::uint64_t seed_;
  std::mt19937_64 dice_;           // of the robots
  double delayed_ = 0;             // how often an action takes longer
  double stops_ = 0;               // how often it takes very long
  std::vector<double> slowness_;   // by agent
  std::vector<ActionIndex> last_;  // by agent: in which it dies; kNoAction: it does not
  bool dies_ = false;
};

}  // namespace grove::detail::testing
