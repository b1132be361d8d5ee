// SPDX-License-Identifier: MIT
// Tests problems that several ranks build together; here the ranks are threads. Such a problem lies
// in shared memory and equals a problem that one rank builds alone.
#include "mpi/shared_problem.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "planning/agent_stops_cache.h"
#include "tests/fuzz/random_instance.h"
#include "tests/primal/crowd.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace shared_problem_test {

// Memory that resembles an MPI window: common to all members, aligned, with only the first bytes
// zero.
struct Host {
  Host(std::size_t bytes, std::size_t zero_bytes)
      : size(bytes), memory(static_cast<std::byte*>(::operator new(bytes, kAligned))) {
    std::memset(memory, 0xA5, bytes);
    std::memset(memory, 0, zero_bytes);
  }
  ~Host() { ::operator delete(memory, kAligned); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  static constexpr std::align_val_t kAligned{SharedArrays::kAlignment};
  const std::size_t size;
  std::byte* const memory;
};

class Part : public SharedMemory {
 public:
  Part(const Host& host, int member, int members) {
    bytes_ = {host.memory, host.size};
    member_ = member;
    members_ = members;
  }
};

// Returns the first difference from a problem that one rank built alone, or an empty string.
std::string difference(const Problem& shared, const Problem& alone) {
  const Instance& instance = alone.instance;
  const State states = instance.world().state_count();
  const auto same = [&](DistanceView one, DistanceView other) {
    for (State state = 0; state < states; ++state)
      if (one[state] != other[state]) return false;
    return true;
  };
  if (!shared.distances.complete()) return "not complete";
  if (shared.distances.has_ports() != alone.distances.has_ports()) return "ports";
  for (TaskIndex task = 0; task < instance.task_count(); ++task)
    if (!same(shared.distances.to_task(task), alone.distances.to_task(task))) return "to a task";
  AgentStopsCache stops(instance, shared.distances);
  AgentStopsCache expected(instance, alone.distances);
  std::mt19937 dice(1);
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    AgentStops& one = stops.of(agent);
    AgentStops& other = expected.of(agent);
    for (State state = 0; state < states; ++state) {
      if (one.stop_at(state) != other.stop_at(state)) return "the stop at a state";
      for (int port = 0; port < other.count() * other.ports(); ++port)
        if (one.to_port(state, port) != other.to_port(state, port)) return "to a port";
      if (!other.rests_on_last_stop() && one.to_rest(state) != other.to_rest(state))
        return "to rest";
    }
    if (other.count() == 0) continue;
    if (!one.cost_to_go().extend(1, Limits()) || !other.cost_to_go().extend(1, Limits()))
      return "not widened";
    if (one.cost_to_go().outside_bound() != other.cost_to_go().outside_bound()) return "beyond";
    for (int i = 0; i < 300; ++i) {
      const int port =
          static_cast<int>(dice() % static_cast<unsigned>(other.count() * other.ports()));
      const StopSet left = dice() & other.all() & ~(StopSet{1} << (port / other.ports()));
      if (one.cost_to_go().cost_to_go(left, port) != other.cost_to_go().cost_to_go(left, port))
        return "a completion";
    }
  }
  return "";
}

// Compares the problems that `members` members build concurrently with an unshared one.
void expect_same(const Instance& instance, int members, const std::string& which) {
  const ArrayLayout layout = array_layout(instance);
  const Host host(SharedArrays::bytes(layout), SharedArrays::zero_bytes(layout));
  const Problem alone(instance, Limits());
  std::mutex speaking;
  std::vector<std::jthread> threads;
  for (int member = 0; member < members; ++member)
    threads.emplace_back([&, member] {
      const Part part(host, member, members);
      const SharedArrays arrays(part.bytes(), layout, member, members);
      const Problem shared(instance, Limits(), 1, nullptr, &arrays);
      const std::string wrong = difference(shared, alone);
      const std::lock_guard lock(speaking);
      EXPECT_EQ(wrong, "") << which;
    });
}

TEST(SharedProblem, EqualsUnsharedProblemOfADenseInstance) {
  for (const std::uint64_t seed : {1, 2, 3})
    expect_same(testing::random_crowd({}, seed), 3, "a dense instance");
}

// Grids and roadmaps, agents that turn, and tasks with a duration.
TEST(SharedProblem, EqualsUnsharedProblemOfAnyWorld) {
  for (int seed = 1; seed <= testing::fuzz_rounds(100); ++seed)
    expect_same(fuzz::random_world(static_cast<std::uint64_t>(seed)).build(), 2,
                std::to_string(seed));
}

// Agent a has twenty stops, too many for a sequence table. Agent b has fourteen, which are few
// enough.
Instance agents_with_many_stops() {
  InstanceBuilder builder(Grid(30, 30, std::vector<bool>(900, true)));
  builder.add_agent("a", {0, 0}, Position{29, 29});
  builder.add_agent("b", {1, 0}, Position{28, 29});
  for (int task = 0; task < 20; ++task) {
    std::vector<std::string> agents{"a"};
    if (task < 14) agents.emplace_back("b");
    builder.add_task("t" + std::to_string(task), Place{40 + 37 * task}, agents);
  }
  return std::move(builder).build();
}

TEST(SharedProblem, EqualsUnsharedProblemWithManyStops) {
  expect_same(agents_with_many_stops(), 2, "many stops");
}

TEST(SharedProblem, LiesInSharedMemory) {
  const Instance instance = agents_with_many_stops();
  const ArrayLayout layout = array_layout(instance);
  const Host host(SharedArrays::bytes(layout), SharedArrays::zero_bytes(layout));
  const Part part(host, 0, 1);
  const SharedProblem shared(instance, Limits(), 1, part);
  AgentStopsCache stops(instance, shared.problem().distances);
  for (AgentIndex agent = 0; agent < 2; ++agent)
    ASSERT_TRUE(stops.of(agent).cost_to_go().extend(1, Limits()));
  const SharedArrays arrays(part.bytes(), layout, 0, 1);
  const auto is_there = [&](ArrayKind kind, std::size_t number) {
    return arrays.array(kind, number).await(Limits()) != nullptr;
  };
  for (std::size_t set = 0; set < DistanceFields::layout_of(instance).size(); ++set)
    EXPECT_TRUE(is_there(ArrayKind::kDistances, set)) << set;
  EXPECT_TRUE(is_there(ArrayKind::kStopsOfStates, 0));
  EXPECT_TRUE(is_there(ArrayKind::kStopsOfStates, 1));
  EXPECT_FALSE(is_there(ArrayKind::kSequenceTable, 0));
  EXPECT_TRUE(is_there(ArrayKind::kSequenceTable, 1));
}

TEST(SharedProblem, IsLocalWithoutSharedMemory) {
  const Instance instance = agents_with_many_stops();
  const SharedMemory none;
  const SharedProblem problem(instance, Limits(), 1, none);
  EXPECT_EQ(difference(problem.problem(), Problem(instance, Limits())), "");
  EXPECT_EQ(SharedProblem::need(instance).bytes, 0U);  // too small to be shared
}

}  // namespace shared_problem_test
}  // namespace grove::detail
