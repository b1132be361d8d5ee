// SPDX-License-Identifier: MIT
#include "tests/execution/delays.h"

#include <cmath>

#include "model/random.h"

namespace grove::detail::testing {
namespace {

double random_fraction(std::mt19937_64& dice) {
  return std::uniform_real_distribution<double>(0, 1)(dice);
}

}  // namespace

Delays::Delays(const ActionDependencyGraph& order, std::uint64_t seed, bool may_fail)
    : order_(order),
      seed_(seed),
      dice_(seed),
      delayed_(random_fraction(dice_)),
      stops_(random_fraction(dice_) * 0.1),
      last_(static_cast<std::size_t>(order.agent_count()), kNoAction) {
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
    slowness_.push_back(random_fraction(dice_) < 0.2 ? 1 + 4 * random_fraction(dice_) : 1);
    const ActionIndex actions = order.end_of(agent) - order.begin_of(agent);
    if (!may_fail || actions == 0 || random_fraction(dice_) > 0.2) continue;
    last_[agent] =
        order.begin_of(agent) + std::uniform_int_distribution<ActionIndex>(0, actions - 1)(dice_);
    fails_ = true;
  }
}

Time Delays::operator()(ActionIndex action, Time) {
  const Action& a = order_.actions()[action];
  if (last_[a.agent] == action) return kNever;
  double duration = a.steps * slowness_[a.agent];
  const auto draw = [&](std::uint64_t number) {
    return unit_draw(seed_, 4 * static_cast<std::uint64_t>(action) + number);
  };
  if (draw(0) < delayed_) duration += 5 * draw(1);
  if (draw(2) < stops_) duration += 200 * draw(3);
  return static_cast<Time>(std::ceil(duration));
}

}  // namespace grove::detail::testing
