// SPDX-License-Identifier: MIT
// Tests instances in which agents choose tasks and destinations, and the check of their plans.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "model/check.h"
#include "model/fingerprint.h"

namespace grove::detail {
namespace choices_test {

using Ids = std::vector<std::string>;

constexpr int kWidth = 5;
constexpr Cell at(int x, int y) {
  return kWidth * y + x;
}

InstanceBuilder builder() {
  return InstanceBuilder(Grid(kWidth, 2, std::vector<bool>(2 * kWidth, true)));
}

AgentSpec agent(const std::string& id, Place start, std::optional<Place> goal,
                std::vector<Place> goals = {}) {
  return {.id = id, .start = {.place = start}, .goal = goal, .goals = std::move(goals)};
}

// a may end at either end of the first row, b on (0, 1), c and d without a destination; d must
// visit "own" at (4, 1). Any agent may do "any" at (2, 0), which takes a step; two of a, b, d must
// visit "two" at (3, 1).
Instance instance() {
  InstanceBuilder made = builder();
  made.add_agent(agent("a", at(1, 0), std::nullopt, {at(0, 0), at(4, 0)}));
  made.add_agent(agent("b", at(0, 1), at(0, 1)));
  made.add_agent(agent("c", at(2, 0), std::nullopt));
  made.add_agent(agent("d", at(3, 1), std::nullopt));
  made.add_task("any", at(2, 0), Ids{"a", "b", "c", "d"}, 1, 1);
  made.add_task("two", at(3, 1), Ids{"a", "b", "d"}, 0, 2);
  made.add_task("own", at(4, 1), Ids{"d"});
  return std::move(made).build();
}

constexpr AgentIndex kA = 0;
constexpr AgentIndex kB = 1;
constexpr AgentIndex kC = 2;
constexpr AgentIndex kD = 3;

// a goes to (0, 0) for 1; b goes to "two" and back for 8; c does "any" for 1; d visits "two" at its
// start and goes to "own" for 1.
Solution valid_solution() {
  Plan plan;
  plan.agents = {
      {1, {}, {at(1, 0), at(0, 0)}},
      {8,
       {1},
       {at(0, 1), at(1, 1), at(2, 1), at(2, 1), at(3, 1), at(2, 1), at(1, 1), at(1, 1), at(0, 1)},
       {{1, 4, 4}}},
      {1, {0}, {at(2, 0), at(2, 0)}, {{0, 0, 1}}},
      {1, {1, 2}, {at(3, 1), at(4, 1)}, {{1, 0, 0}}},
  };
  plan.cost = 11;
  Solution solution;
  solution.status = Status::kFeasible;
  solution.plan = plan;
  return solution;
}

// Returns the violations of the valid solution after `change`, one line "place: message" for each.
std::string verdict(const std::function<void(Plan&)>& change) {
  Solution solution = valid_solution();
  change(*solution.plan);
  std::string text;
  for (const Violation& violation : check(instance(), solution))
    text += (text.empty() ? "" : "\n") + violation.json_pointer + ": " + violation.message;
  return text;
}

TEST(Choices, TasksOfAgents) {
  const Instance made = instance();
  EXPECT_TRUE(made.has_choices());
  EXPECT_EQ(made.agent(kA).options, (std::vector<TaskIndex>{0, 1}));
  EXPECT_EQ(made.agent(kC).options, (std::vector<TaskIndex>{0}));
  EXPECT_EQ(made.agent(kD).options, (std::vector<TaskIndex>{0, 1}));
  EXPECT_EQ(made.agent(kD).tasks, (std::vector<TaskIndex>{2}));
  EXPECT_TRUE(made.agent(kA).has_destination());
  EXPECT_TRUE(made.agent(kC).is_idle());
  EXPECT_FALSE(made.agent(kD).is_idle());
  EXPECT_TRUE(made.may_rest(kA, at(4, 0)));
  EXPECT_FALSE(made.may_rest(kA, at(3, 0)));
}

// A need of all agents is the default.
TEST(Choices, NeedOfAllAgentsIsNoChoice) {
  for (const std::optional<int> need : {std::optional<int>(), std::optional(2)}) {
    InstanceBuilder made = builder();
    made.add_agent(agent("a", 0, std::nullopt));
    made.add_agent(agent("b", 1, std::nullopt));
    made.add_task("t", 4, Ids{"a", "b"}, 0, need);
    const Instance done = std::move(made).build();
    EXPECT_FALSE(done.has_choices());
    EXPECT_EQ(done.agent(0).tasks, (std::vector<TaskIndex>{0}));
    EXPECT_FALSE(done.task(0).has_stated_visits());
  }
}

// The limit applies to the tasks that an agent must visit.
TEST(Choices, AnAgentMayHaveManyOptions) {
  InstanceBuilder made = builder();
  made.add_agent(agent("a", 0, std::nullopt));
  made.add_agent(agent("b", 1, std::nullopt));
  for (int i = 0; i < 200; ++i) made.add_task("t" + std::to_string(i), 4, Ids{"a", "b"}, 0, 1);
  EXPECT_EQ(std::move(made).build().agent(0).options.size(), 200u);
}

// Returns the message of the InstanceError that `act` throws.
std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InstanceError& error) {
    return error.field() + ": " + error.what();
  }
  return "accepted";
}

TEST(Choices, RefusesBadInput) {
  const auto task = [](int need) {
    InstanceBuilder made = builder();
    made.add_agent(agent("a", 0, std::nullopt));
    made.add_task("t", 4, Ids{"a"}, 0, need);
  };
  EXPECT_EQ(refusal([&] { task(0); }),
            "need: found 0; expected 1 to 1, the number of agents of the task");
  EXPECT_EQ(refusal([&] { task(2); }),
            "need: found 2; expected 1 to 1, the number of agents of the task");
  const auto goals = [](std::optional<Place> goal, std::vector<Place> choice) {
    builder().add_agent(agent("a", 0, goal, std::move(choice)));
  };
  EXPECT_EQ(refusal([&] { goals(3, {4}); }),
            "goals: found both 'goal' and 'goals'; expected one of them");
  EXPECT_EQ(refusal([&] {
              goals({}, {3, 4, 3});
            }),
            "goals/2: cell [3, 0] is listed twice; expected each place once");
}

TEST(Choices, FingerprintsDiffer) {
  const auto print = [](std::vector<Place> goals, std::optional<int> need) {
    InstanceBuilder made = builder();
    made.add_agent(agent("a", 0, std::nullopt, std::move(goals)));
    made.add_agent(agent("b", 1, std::nullopt));
    made.add_agent(agent("c", 2, std::nullopt));
    made.add_task("t", 4, Ids{"a", "b", "c"}, 0, need);
    return fingerprint(std::move(made).build());
  };
  const std::vector<std::uint64_t> prints{print({}, {}),  print({}, 1),      print({}, 2),
                                          print({3}, {}), print({3, 4}, {}), print({4, 3}, 1)};
  for (std::size_t i = 0; i < prints.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(prints[i], prints[k]) << i << " " << k;
}

TEST(Choices, AcceptsAValidPlan) {
  EXPECT_EQ(verdict([](Plan&) {}), "");
}

TEST(Choices, MoreVisitsThanNeeded) {
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kB].work.insert(plan.agents[kB].work.begin(), WorkTime{1, 4, 4});
            }),
            "/agents/1/work/1: agent 'b' does task 'two' a second time; expected each once");
}

TEST(Choices, CountsOnlyStatedVisits) {
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kB].work.clear();
              plan.agents[kB].sequence.clear();
            }),
            "/agents: task 'two' is visited by 1 of its agents; expected at least 2");
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kC].work.clear();
              plan.agents[kC].sequence.clear();
            }),
            "/agents/2/cost: agent 'c' finishes at time 0, but the plan claims 1\n"
            "/agents: task 'any' is visited by 0 of its agents; expected at least 1\n"
            "/cost: the agents' costs add up to 10, but the plan claims 11");
}

TEST(Choices, TheSequenceHasOnlyStatedVisits) {
  EXPECT_EQ(verdict([](Plan& plan) { plan.agents[kB].work.clear(); }),
            "/agents/1/sequence: task 'two' has no entry in \"work\"; expected every task of agent "
            "'b' exactly once\n"
            "/agents: task 'two' is visited by 1 of its agents; expected at least 2");
}

TEST(Choices, StatedVisitsAreOnThePlaceOfTheTask) {
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kB].work[0] = {1, 3, 3};
            }),
            "/agents/1/work/0: agent 'b' is on [2, 1] when it begins task 'two'; expected [3, 1]");
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kB].work[0] = {1, 4, 5};
            }),
            "/agents/1/work/0: task 'two' takes 0 steps, but this work goes from 4 to 5\n"
            "/agents/1/path/5: agent 'b' leaves [3, 1] at work on task 'two'");
}

TEST(Choices, OnlyAgentsOfATaskVisitIt) {
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kC].work.push_back({1, 1, 1});
              plan.agents[kC].sequence.push_back(1);
            }),
            "/agents/2/work/1: task 'two' does not list agent 'c'; expected a task that does");
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kD].work.push_back({2, 1, 1});
            }),
            "/agents/3/work/1: task 'own' takes no time and all its agents must visit it; expected "
            "only tasks with a duration or a choice of agents");
}

TEST(Choices, EndsOnOneOfItsGoals) {
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kA].path = {at(1, 0)};
              plan.agents[kA].cost = 0;
              plan.cost = 10;
            }),
            "/agents/0/path/0: agent 'a' ends on [1, 0]; expected one of its goals");
}

// An agent that must visit a task rests on the place of a task that it has visited, perhaps by
// choice.
TEST(Choices, RestsOnAVisitedTask) {
  const auto comes_back = [](Plan& plan) {
    plan.agents[kD].path = {at(3, 1), at(4, 1), at(3, 1)};
    plan.agents[kD].cost = 2;
    plan.agents[kB] = {0, {}, {at(0, 1)}};
    plan.cost = 4;
  };
  EXPECT_EQ(verdict(comes_back),
            "/agents: task 'two' is visited by 1 of its agents; expected at least 2");
  EXPECT_EQ(
      verdict([&](Plan& plan) {
        comes_back(plan);
        plan.agents[kD].sequence = {2};
        plan.agents[kD].work.clear();
      }),
      "/agents/3/path/2: agent 'd' ends on [3, 1]; expected one of its own tasks\n"
      "/agents/3/sequence/0: agent 'd' has no goal and ends on [3, 1]; expected the last task "
      "of its sequence there, found 'own'\n"
      "/agents: task 'two' is visited by 0 of its agents; expected at least 2");
}

TEST(Choices, RestsAnywhereWithoutATaskThatItMustVisit) {
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kC].path = {at(2, 0), at(2, 0), at(3, 0)};
              plan.agents[kC].cost = 2;
              plan.cost = 12;
            }),
            "");
}

// The cost of an agent is not below the end of its last stated visit.
TEST(Choices, StatedVisitsCount) {
  EXPECT_EQ(verdict([](Plan& plan) {
              plan.agents[kC].work[0] = {0, 1, 2};
            }),
            "/agents/2/cost: agent 'c' finishes at time 2, but the plan claims 1\n"
            "/cost: the agents' costs add up to 12, but the plan claims 11");
}

}  // namespace choices_test
}  // namespace grove::detail
