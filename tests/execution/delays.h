// SPDX-License-Identifier: MIT
// Random disturbances of an execution.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail::testing {

// One random schedule: some actions take longer, some robots are slower, there are long stops, and
// with `may_fail` some robots fail. It depends only on the seed, not on when actions begin.
class Delays {
 public:
  Delays(const ActionDependencyGraph& order, std::uint64_t seed, bool may_fail = false);

  Time operator()(ActionIndex action, Time begin);
  bool any_robot_fails() const { return fails_; }

 private:
  const ActionDependencyGraph& order_;
  std::uint64_t seed_;
  std::mt19937_64 dice_;           // draws the parameters of the robots
  double delayed_ = 0;             // probability that an action takes longer
  double stops_ = 0;               // probability that it takes much longer
  std::vector<double> slowness_;   // by agent
  std::vector<ActionIndex> last_;  // by agent: action in which it fails; kNoAction: none
  bool fails_ = false;
};

}  // namespace grove::detail::testing
