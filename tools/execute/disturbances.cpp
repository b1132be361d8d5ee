// SPDX-License-Identifier: MIT
#include "tools/execute/disturbances.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "io/input_error.h"
#include "model/parse_number.h"
#include "model/random.h"
#include "tools/common/options.h"
#include "tools/execute/robots.h"

namespace grove::detail {
namespace {

constexpr double kMaxSlowFactor = 1000;

double factor_of(const std::string& option, const std::string& text, const std::string& number) {
  std::size_t read = 0;
  double factor = 0;
  try {
    factor = std::stod(number, &read);
  } catch (const std::exception&) {
  }
  if (read != number.size() || !(factor >= 1 && factor <= kMaxSlowFactor))
    refuse(option, text, "ROBOT=FACTOR, a factor from 1 to 1000");
  return factor;
}

}  // namespace

Disturbances::Disturbances(const DisturbanceArguments& arguments, const Instance& instance)
    : delayed_(arguments.delayed),
      delay_steps_(static_cast<Time>(arguments.delay_steps)),
      slowness_(static_cast<std::size_t>(instance.agent_count()), 1) {
  for (const std::string& text : arguments.slow) {
    const auto split = text.rfind('=');
    if (split == std::string::npos) refuse("--slow", text, "ROBOT=FACTOR");
    const AgentIndex agent = robot_of("--slow", text, text.substr(0, split), instance);
    slowness_[agent] = factor_of("--slow", text, text.substr(split + 1));
  }
  read_stops(arguments, instance);
}

void Disturbances::read_stops(const DisturbanceArguments& arguments, const Instance& instance) {
  for (const std::string& text : arguments.stop) {
    const auto at = text.rfind('@');
    const auto split = text.rfind('=');
    if (at == std::string::npos || split == std::string::npos || split < at)
      refuse("--stop", text, "ROBOT@TIME=STEPS");
    stops_.push_back(
        {robot_of("--stop", text, text.substr(0, at), instance),
         static_cast<Time>(
             parse_integer("--stop", text.substr(at + 1, split - at - 1), kPlanSteps)),
         static_cast<Time>(parse_integer("--stop", text.substr(split + 1), kPlanSteps))});
  }
  for (const std::string& text : arguments.failures) {
    const auto at = text.rfind('@');
    if (at == std::string::npos) refuse("--fail", text, "ROBOT@TIME");
    stops_.push_back({robot_of("--fail", text, text.substr(0, at), instance),
                      static_cast<Time>(parse_integer("--fail", text.substr(at + 1), kPlanSteps)),
                      kNever});
  }
}

// For a slow robot, rounds the total duration of its actions so far instead of each duration.
Duration Disturbances::durations(const ActionDependencyGraph& order, std::uint64_t seed) const {
  struct Run {
    std::vector<double> owed;  // by agent: fraction of a time step that is not yet added
    std::vector<Stop> stops;   // stops that have not happened yet
  };
  const auto state = std::make_shared<Run>(Run{std::vector<double>(slowness_.size()), stops_});
  return [this, seed, state, &order](ActionIndex index, Time begin) {
    const Action& action = order.actions()[index];
    double& owed = state->owed[action.agent];
    owed += action.steps * (slowness_[action.agent] - 1);
    const Time slower = static_cast<Time>(owed);
    owed -= slower;
    Time steps = action.steps + slower;
    const auto draw = static_cast<std::uint64_t>(index) * 2;
    if (unit_draw(seed, draw) < delayed_)
      steps += 1 + static_cast<Time>(unit_draw(seed, draw + 1) * delay_steps_);
    for (Stop& stop : state->stops) {
      if (stop.agent != action.agent || begin + steps <= stop.from) continue;
      stop.agent = -1;  // this stop has happened
      if (stop.steps == kNever) return kNever;
      steps += stop.steps;
    }
    return steps;
  };
}

}  // namespace grove::detail
