// SPDX-License-Identifier: MIT
// grove-fuzz-execution: executes random plans with random disturbances. Robots must not collide,
// and no robot may wait forever. For comparison, it applies the same disturbances to robots that
// follow the times of the plan.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>

#include "engine/solve.h"
#include "execution/execution_trace.h"
#include "execution/switching.h"
#include "io/instance_file.h"
#include "io/plan_file.h"
#include "model/random.h"
#include "tests/execution/collisions.h"
#include "tests/execution/delays.h"
#include "tests/fuzz/random_instance.h"

namespace grove::detail {
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
  std::int64_t switches = 0;
  // Sums of ratios to the corresponding value of the plan.
  double undisturbed = 0;
  double makespans = 0;
  double makespans_switching = 0;
  double costs = 0;
  double costs_switching = 0;
  int worse = 0;  // executions whose sum of costs is higher with switching
};

std::optional<Plan> solved(const Instance& instance) {
  SolveOptions options;
  options.omega = Omega::infinite();
  Limits limits;
  limits.set_deadline(std::chrono::steady_clock::now() + std::chrono::seconds(1));
  return solve(instance, options, limits).plan;
}

// An instance with up to two groups of four robots, each group rotating on a square of four cells,
// and up to two other robots.
Instance roundabouts(std::uint64_t seed) {
  Random random(seed);
  const int width = 5 + random.below(3);
  const int height = 4 + random.below(3);
  InstanceBuilder builder(
      Grid(width, height, std::vector<bool>(static_cast<std::size_t>(width * height), true)));
  int robots = 0;
  const auto add = [&](Position start, Position goal) {
    try {
      builder.add_agent(fmt::format("r{}", robots), start, goal);
      ++robots;
    } catch (const InstanceError&) {  // occupied
    }
  };
  constexpr Position kRound[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const int left : {0, 3}) {
    const int top = random.below(height - 1);
    const int turn = 1 + random.below(3);
    if (left + 1 >= width) continue;
    for (int i = 0; i < 4; ++i) {
      const Position from = kRound[i];
      const Position to = kRound[(i + turn) % 4];
      add({left + from.x, top + from.y}, {left + to.x, top + to.y});
    }
  }
  for (int i = random.below(3); i > 0; --i)
    add({random.below(width), random.below(height)}, {random.below(width), random.below(height)});
  return std::move(builder).build();
}

// Returns an execution in which each robot ignores the others but starts no action before its time
// in the plan.
ExecutionTrace by_clock(const ActionDependencyGraph& order, Delays delays) {
  ExecutionTrace trace{std::vector<Time>(order.actions().size()),
                       std::vector<Time>(order.actions().size())};
  for (std::int32_t number = 0; number < order.step_count(); ++number)
    for (const ActionIndex a : order.step(number)) {
      const Time ready = order.before(a) == kNoAction ? 0 : trace.end[order.before(a)];
      trace.begin[a] = std::max(ready, order.actions()[a].begin);
      trace.end[a] = trace.begin[a] + delays(a, trace.begin[a]);
    }
  return trace;
}

// Returns the makespan and the sum of costs of an execution.
std::pair<double, double> makespan_and_cost(const ActionDependencyGraph& order,
                                            const ExecutionTrace& trace) {
  Time makespan = 0;
  Cost cost = 0;
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
    makespan = std::max(makespan, trace.finish(order, agent));
    cost += trace.finish(order, agent);
  }
  return {makespan, static_cast<double>(cost)};
}

void drive_all(const Instance& instance, const Plan& plan, std::int64_t drives, std::uint64_t seed,
               Counts& counts) {
  const World& world = instance.world();
  const ActionDependencyGraph order(instance, plan);
  std::vector<State> starts;
  for (const Agent& agent : instance.agents()) starts.push_back(agent.start);
  const double planned = std::max(1, std::ranges::max(plan.agents, {}, &AgentPlan::cost).cost);
  const double cost = std::max<double>(1, static_cast<double>(plan.cost));
  ++counts.plans;
  counts.rings += static_cast<int>(order.rings());
  counts.undisturbed += makespan_and_cost(order, simulate_nominal(order)).first / planned;
  const auto count_failures = [&](const ExecutionTrace& executed) {
    counts.collisions += collision(world, order, executed, starts).empty() ? 0 : 1;
    counts.deadlocks += blocked_robots(order, executed).empty() ? 0 : 1;
  };
  for (std::int64_t i = 0; i < drives; ++i, ++counts.drives) {
    const Delays delays(order, seed + static_cast<std::uint64_t>(i));
    const ExecutionTrace executed = simulate(order, delays);
    count_failures(executed);
    const SwitchableTrace switched = simulate_switchable(world, plan, order, delays);
    count_failures(switched.trace);
    counts.switches += switched.switches;
    counts.collisions_by_clock +=
        collision(world, order, by_clock(order, delays), starts).empty() ? 0 : 1;
    const auto [makespan, sum] = makespan_and_cost(order, executed);
    const auto [makespan_switching, sum_switching] = makespan_and_cost(order, switched.trace);
    counts.makespans += makespan / planned;
    counts.makespans_switching += makespan_switching / planned;
    counts.costs += sum / cost;
    counts.costs_switching += sum_switching / cost;
    counts.worse += sum_switching > sum ? 1 : 0;
  }
}

void print(const Counts& c) {
  const auto drives = static_cast<double>(std::max<std::int64_t>(1, c.drives));
  fmt::print("{} plans, {} rings of robots in them; {} drives, each with and without switching\n",
             c.plans, c.rings, c.drives);
  fmt::print("along the passing order: {} collide, {} do not end\n", c.collisions, c.deadlocks);
  fmt::print("by the clock:            {} collide\n", c.collisions_by_clock);
  fmt::print("{:<36}{:>10}{:>14}\n", "times the plan's, on average", "makespan", "sum of costs");
  fmt::print("{:<36}{:>10.3f}\n", "undisturbed", c.undisturbed / std::max(1, c.plans));
  fmt::print("{:<36}{:>10.3f}{:>14.3f}\n", "delayed", c.makespans / drives, c.costs / drives);
  fmt::print("{:<36}{:>10.3f}{:>14.3f}   {} places switched; worse by it: {} drives\n",
             "delayed, switching", c.makespans_switching / drives, c.costs_switching / drives,
             c.switches, c.worse);
}

}  // namespace
}  // namespace grove::detail

int main(int argc, char** argv) {
  using namespace grove::detail;
  CLI::App app("Random plans, or one, driven with random troubles", "grove-fuzz-execution");
  int plans = 100;
  std::int64_t drives = 100;
  std::uint64_t seed = 1;
  std::string instance_file;
  std::string plan_file;
  app.add_option("INSTANCE", instance_file, "drive a plan of this, in place of random ones");
  app.add_option("PLAN", plan_file);
  app.add_option("--plans", plans, "number of plans; in every third one robots rotate")
      ->capture_default_str();
  app.add_option("--drives", drives, "executions per plan")->capture_default_str();
  app.add_option("--seed", seed, "of the first one")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  Counts counts;
  if (!instance_file.empty()) {
    const Instance instance = read_instance(instance_file).instance;
    drive_all(instance, *read_solution(plan_file, instance).plan, drives, seed << 32, counts);
  }
  for (; instance_file.empty() && counts.plans < plans; ++seed) {
    const Instance instance = seed % 3 == 0 ? roundabouts(seed) : fuzz::random_world(seed).build();
    if (const auto plan = solved(instance)) drive_all(instance, *plan, drives, seed << 32, counts);
  }
  print(counts);
  return counts.collisions + counts.deadlocks > 0 ? 1 : 0;
}
