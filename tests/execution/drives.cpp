// SPDX-License-Identifier: MIT
// grove-drives: random plans, random troubles; nobody collides and nobody waits for ever. Beside it
// the same troubles with robots that keep to the clock.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>

#include "grove/engine/solve.h"
#include "grove/execution/drive.h"
#include "tests/execution/collisions.h"
#include "tests/execution/delays.h"
#include "tests/fuzz/random_instance.h"

namespace grove {
namespace {

using testing::collision;
using testing::Delays;

struct Counts {
  int plans = 0;
  int rings = 0;
  std::int64_t drives = 0;
  std::int64_t collisions = 0;
  std::int64_t deadlocks = 0;
  std::int64_t collisions_by_clock = 0;
  double longer = 0;  // sum of makespans over those of plans
};

std::optional<Plan> solved(const Instance& instance) {
  SolveOptions options;
  options.omega = Omega::infinite();
  Limits limits;
  limits.set_deadline(std::chrono::steady_clock::now() + std::chrono::seconds(1));
  return solve(instance, options, limits).plan;
}

// As if there were nobody else, but never before the time of the plan.
Drive by_clock(const PassingOrder& order, Delays delays) {
  Drive drive{std::vector<Time>(order.actions().size()), std::vector<Time>(order.actions().size())};
  for (std::int32_t number = 0; number < order.step_count(); ++number)
    for (const ActionIndex a : order.step(number)) {
      const Time ready = order.before(a) == kNoAction ? 0 : drive.end[order.before(a)];
      drive.begin[a] = std::max(ready, order.actions()[a].begin);
      drive.end[a] = drive.begin[a] + delays(a, drive.begin[a]);
    }
  return drive;
}

void drive_all(const Instance& instance, const Plan& plan, std::int64_t drives, std::uint64_t seed,
               Counts& counts) {
  const PassingOrder order(instance, plan);
  std::vector<State> starts;
  for (const Agent& agent : instance.agents()) starts.push_back(agent.start);
  const Time planned = std::max(1, std::ranges::max(plan.agents, {}, &AgentPlan::cost).cost);
  ++counts.plans;
  counts.rings += static_cast<int>(order.rings());
  for (std::int64_t i = 0; i < drives; ++i, ++counts.drives) {
    const Delays delays(order, seed + static_cast<std::uint64_t>(i));
    const Drive driven = drive(order, delays);
    counts.collisions += collision(instance.world(), order, driven, starts).empty() ? 0 : 1;
    counts.deadlocks += stuck(order, driven).empty() ? 0 : 1;
    counts.collisions_by_clock +=
        collision(instance.world(), order, by_clock(order, delays), starts).empty() ? 0 : 1;
    Time makespan = 0;
    for (AgentIndex agent = 0; agent < order.agent_count(); ++agent)
      makespan = std::max(makespan, driven.finish(order, agent));
    counts.longer += static_cast<double>(makespan) / planned;
  }
}

void print(const Counts& c) {
  fmt::print("{} plans, {} rings of robots in them, {} drives\n", c.plans, c.rings, c.drives);
  fmt::print(
      "along the passing order: {} collide, {} do not end; makespan {:.2f} times the plan's\n",
      c.collisions, c.deadlocks,
      c.longer / static_cast<double>(std::max<std::int64_t>(1, c.drives)));
  fmt::print("by the clock:            {} collide\n", c.collisions_by_clock);
}

}  // namespace
}  // namespace grove

int main(int argc, char** argv) {
  CLI::App app("Random plans driven with random troubles", "grove-drives");
  int plans = 100;
  std::int64_t drives = 100;
  std::uint64_t seed = 1;
  app.add_option("--plans", plans, "so many plans")->capture_default_str();
  app.add_option("--drives", drives, "so many drives of each")->capture_default_str();
  app.add_option("--seed", seed, "of the first one")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  grove::Counts counts;
  for (; counts.plans < plans; ++seed) {
    const grove::Instance instance = grove::fuzz::random_world(seed).build();
    if (const auto plan = grove::solved(instance))
      grove::drive_all(instance, *plan, drives, seed << 32, counts);
  }
  grove::print(counts);
  return counts.collisions + counts.deadlocks > 0 ? 1 : 0;
}
