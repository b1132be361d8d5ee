// SPDX-License-Identifier: MIT
// What happens to robots on the way, as one types it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "execution/execution_trace.h"
#include "model/instance.h"

namespace grove::detail {

// Of a command line.
struct DisturbanceArguments {
  double delayed = 0;             // share of actions that take longer
  std::int64_t delay_steps = 3;   // by so many steps at most
  std::vector<std::string> slow;  // ROBOT=FACTOR
  std::vector<std::string> stop;  // ROBOT@TIME=STEPS
  std::vector<std::string> dies;  // ROBOT@TIME
};

// The same of an instance's robots, in numbers.
class Disturbances {
 public:
  // Throws CLI::ValidationError, naming option and value.
  Disturbances(const DisturbanceArguments& arguments, const Instance& instance);

  // How long actions take in one drive; another seed, another drive.
  Duration durations(const ActionDependencyGraph& order, std::uint64_t seed) const;

 private:
  struct Stop {
    AgentIndex agent = -1;
    Time from = 0;
    Time steps = 0;  // kNever: for good
  };

  void read_stops(const DisturbanceArguments& arguments, const Instance& instance);

  double delayed_;
  Time delay_steps_;
  std::vector<double> slowness_;  // by agent
  std::vector<Stop> stops_;
};

}  // namespace grove::detail
