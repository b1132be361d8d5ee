// SPDX-License-Identifier: MIT
// Random disturbances of an execution.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail::testing {

// A random delay schedule: some actions take longer, some robots are slower, some make long stops
// and, with `may_fail`, some fail. It depends only on the seed and `order`, not on the times at
// which actions start. `order` must outlive this object.
class Delays {
 public:
  Delays(const ActionDependencyGraph& order, std::uint64_t seed, bool may_fail = false);

  // Returns the duration of `action`; kNever: the robot fails in it.
  Time operator()(ActionIndex action, Time begin);
  bool any_robot_fails() const { return fails_; }

 private:
  const ActionDependencyGraph& order_;
  std::uint64_t seed_;
  std::mt19937_64 dice_;           // draws the parameters of the robots
  double delayed_ = 0;             // probability that an action takes longer
  double stops_ = 0;               // probability that it takes much longer
  std::vector<double> slowness_;   // by agent
  std::vector<ActionIndex> last_;  // by agent: the action in which it fails; kNoAction: no failure
  bool fails_ = false;
};

}  // namespace grove::detail::testing
