// SPDX-License-Identifier: MIT
// Disturbances of robots during simulated execution: delays, slow robots, stops, failures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "execution/execution_trace.h"
#include "model/instance.h"

namespace grove::detail {

// Values of the command-line options.
struct DisturbanceArguments {
  double delayed = 0;                 // probability that an action is delayed
  std::int64_t delay_steps = 3;       // maximum delay of an action, time steps
  std::vector<std::string> slow;      // ROBOT=FACTOR
  std::vector<std::string> stop;      // ROBOT@TIME=STEPS
  std::vector<std::string> failures;  // ROBOT@TIME
};

// Parsed disturbances for the robots of an instance.
class Disturbances {
 public:
  // Throws CLI::ValidationError, which names the option and its value, for a bad value.
  Disturbances(const DisturbanceArguments& arguments, const Instance& instance);

  // Returns the function that gives the duration of each action in one execution. Use it for one
  // execution only, because it has state. The random delays depend on `seed`. `order` and this
  // object must outlive it.
  Duration durations(const ActionDependencyGraph& order, std::uint64_t seed) const;

 private:
  struct Stop {
    AgentIndex agent = -1;
    Time from = 0;
    Time steps = 0;  // kNever: the robot stops forever
  };

  void read_stops(const DisturbanceArguments& arguments, const Instance& instance);

  double delayed_;
  Time delay_steps_;
  std::vector<double> slowness_;  // by agent
  std::vector<Stop> stops_;
};

}  // namespace grove::detail
