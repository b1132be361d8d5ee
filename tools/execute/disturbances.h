// SPDX-License-Identifier: MIT
// Disturbances of robots, from the command line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "execution/execution_trace.h"
#include "model/instance.h"

namespace grove::detail {

// Values of the options.
struct DisturbanceArguments {
  double delayed = 0;             // share of actions that take longer, 0 to 1
  std::int64_t delay_steps = 3;   // maximum delay of such an action
  std::vector<std::string> slow;  // ROBOT=FACTOR
  std::vector<std::string> stop;  // ROBOT@TIME=STEPS
  std::vector<std::string> failures;  // ROBOT@TIME
};

// The same as numbers, for the robots of an instance.
class Disturbances {
 public:
  // Throws CLI::ValidationError, which names the option and its value.
  Disturbances(const DisturbanceArguments& arguments, const Instance& instance);

  // Returns the durations of actions in one execution; each seed gives another one.
  Duration durations(const ActionDependencyGraph& order, std::uint64_t seed) const;

 private:
  struct Stop {
    AgentIndex agent = -1;
    Time from = 0;
    Time steps = 0;  // kNever: for ever
  };

  void read_stops(const DisturbanceArguments& arguments, const Instance& instance);

  double delayed_;
  Time delay_steps_;
  std::vector<double> slowness_;  // by agent
  std::vector<Stop> stops_;
};

}  // namespace grove::detail
