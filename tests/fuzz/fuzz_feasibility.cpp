// SPDX-License-Identifier: MIT
// grove-fuzz-feasibility: tests that pebble_motion_infeasibility() finds a reason for exactly those
// dense instances that have no plan. Exit codes: 0 no failure, 1 a wrong answer, 2 bad usage.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "search/pebble_motion.h"
#include "tests/fuzz/random.h"
#include "tests/fuzz/random_crowd.h"
#include "tests/oracle/arrangements.h"

namespace grove::detail::fuzz {
namespace {

using oracle::Places;

struct Arguments {
  int tiny = 2000;
  int count = 1000;
  std::uint64_t seed = 1;
};

// Tests tiny dense instances against the set of all reachable configurations.
class TinyInstances {
 public:
  void test_seed(std::uint64_t seed) {
    crowd_ = tiny_crowd(seed);
    const Instance instance = crowd_.build();
    const std::set<Places> all = oracle::reachable_configurations(instance, kMaxStates);
    if (all.empty()) return;
    ++crowds_;
    seed_ = seed;
    Random random(seed);
    const Places starts = places(instance);
    test_places(instance, starts, all);
    for (int i = 0; i < kOrders; ++i) {
      test_all(instance, shuffled(starts, random), all);
      test_all(instance, swapped(*std::next(all.begin(), random.below(std::ssize(all))), random),
               all);
    }
  }
  int wrong() const { return wrong_; }
  std::string summary() const {
    return fmt::format("{} tiny instances: {} questions, {} of them infeasible; {} wrong", crowds_,
                       asked_, impossible_, wrong_);
  }

 private:
  static constexpr std::size_t kMaxStates = 50'000;
  static constexpr int kOrders = 10;

  static Places places(const Instance& instance) {
    Places places;
    for (const Agent& agent : instance.agents())
      places.push_back(instance.world().place(agent.start));
    return places;
  }
  static Places shuffled(Places places, Random& random) {
    for (std::size_t i = places.size(); i > 1; --i)
      std::swap(places[i - 1], places[random.below(i)]);
    return places;
  }
  // Swaps the places of agent 0 and a random agent, possibly agent 0 itself.
  static Places swapped(Places places, Random& random) {
    std::swap(places[0], places[random.below(places.size())]);
    return places;
  }
  static Instance with(const Instance& instance, const Places& goals, AgentIndex agent,
                       Place task) {
    auto builder = InstanceBuilder::like(instance);
    for (AgentIndex i = 0; i < instance.agent_count(); ++i)
      builder.add_agent(instance.agent(i).id, instance.agent(i).start, goals[i]);
    builder.add_task("t", task, std::vector<std::string>{instance.agent(agent).id});
    return std::move(builder).build();
  }
  // For each agent and place, tests the instance in which the agent has a task on the place and all
  // agents must return to their starts.
  void test_places(const Instance& instance, const Places& starts, const std::set<Places>& all) {
    const World& world = instance.world();
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
      for (Place place = 0; place < world.place_count(); ++place) {
        if (world.neighbors(place).empty()) continue;
        const bool is_possible =
            std::ranges::any_of(all, [&](const Places& where) { return where[agent] == place; });
        test_instance(with(instance, starts, agent, place), is_possible);
      }
  }
  void test_all(const Instance& instance, const Places& goals, const std::set<Places>& all) {
    test_instance(with(instance, goals, 0, instance.world().place(instance.agent(0).start)),
                  all.contains(goals));
  }
  void test_instance(const Instance& instance, bool is_possible) {
    ++asked_;
    if (!is_possible) ++impossible_;
    const auto reason = pebble_motion_infeasibility(instance);
    if (reason.has_value() != is_possible) return;
    ++wrong_;
    fmt::print("seed {}: WRONG: {}\n{}", seed_, reason ? *reason : "there is no plan",
               crowd_.to_text());
    for (const Agent& agent : instance.agents())
      fmt::print("# {} to {}\n", instance.world().name(agent.start),
                 instance.world().name(*agent.goal));
    fmt::print("# {} visits {}\n", instance.agent(instance.task(0).agents[0]).id,
               instance.world().name(instance.task(0).cell));
  }

  TinyInstance crowd_;
  std::uint64_t seed_ = 0;
  int crowds_ = 0, wrong_ = 0;
  std::int64_t asked_ = 0, impossible_ = 0;
};

// Tests large instances for which the answer is known by construction.
class KnownInstances {
 public:
  void test_seed(std::uint64_t seed) {
    using Clock = std::chrono::steady_clock;
    const KnownCrowd known = known_crowd(seed);
    const auto began = Clock::now();
    const auto reason = pebble_motion_infeasibility(known.instance);
    slowest_ = std::max(slowest_, std::chrono::duration<double>(Clock::now() - began).count());
    ++(known.has_plan ? possible_ : impossible_);
    max_agents_ = std::max(max_agents_, known.instance.agent_count());
    if (reason.has_value() != known.has_plan) return;
    ++wrong_;
    fmt::print("seed {}: WRONG: {}, {} agents: {}\n", seed, known.board,
               known.instance.agent_count(), reason ? *reason : "there is no plan");
  }
  int wrong() const { return wrong_; }
  std::string summary() const {
    return fmt::format(
        "{} instances of up to {} agents, {} with a plan, {} without: {} wrong; slowest {:.1f} ms",
        possible_ + impossible_, max_agents_, possible_, impossible_, wrong_, slowest_ * 1e3);
  }

 private:
  int possible_ = 0, impossible_ = 0, wrong_ = 0, max_agents_ = 0;
  double slowest_ = 0;
};

template <class Tests>
bool all_is_well(std::uint64_t seed, int count) {
  Tests tests;
  for (int i = 0; i < count; ++i) tests.test_seed(seed + static_cast<std::uint64_t>(i));
  fmt::print("{}\n", tests.summary());
  return tests.wrong() == 0;
}

}  // namespace
}  // namespace grove::detail::fuzz

int main(int argc, char** argv) {
  using namespace grove::detail::fuzz;
  Arguments a;
  CLI::App app("Tests the feasibility test of dense instances.", "grove-fuzz-feasibility");
  app.add_option("--tiny", a.tiny,
                 "number of instances of up to nine agents, compared with exhaustive search")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--count", a.count,
                 "number of instances of 10 to 2,000 agents with a known answer")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--seed", a.seed, "seed of the first instance; each next one has the next seed")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const bool tiny = all_is_well<TinyInstances>(a.seed, a.tiny);
  const bool known = all_is_well<KnownInstances>(a.seed, a.count);
  return tiny && known ? 0 : 1;
}
