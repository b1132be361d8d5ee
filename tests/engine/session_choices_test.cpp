// SPDX-License-Identifier: MIT
// Sessions and remainders of instances in which agents choose tasks or destinations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "assignment/assignment.h"
#include "engine/assigned_search.h"
#include "engine/method.h"
#include "engine/session.h"
#include "execution/advance.h"
#include "tests/engine/random_change.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/choices.h"
#include "tests/support/clocks.h"
#include "tests/support/first_violation.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"
#include "tests/support/random_choices.h"

namespace grove::detail {
namespace session_choices_test {

using testing::first_violation;
using Ids = std::vector<std::string>;

constexpr std::int64_t kLimitChecks = 10'000;  // limit on clock readings per solve
constexpr std::size_t kStates = 100'000;

Solution replanned(Session& session, Omega omega = {}, Time commit = 0, int weight = 0) {
  SolveOptions options;
  options.omega = omega;
  options.visit_weight = weight;
  return session.solve(options, testing::ClockReadingLimit(kLimitChecks), nullptr, commit);
}

// A corridor with two agents without a destination at its ends, and tasks t0, t1, ... that need one
// of them. `tasks`: places and durations.
Instance corridor(const std::vector<std::pair<Place, Time>>& tasks, int length = 7) {
  InstanceBuilder builder(testing::grid_of({std::string(static_cast<std::size_t>(length), '.')}));
  builder.add_agent("left", Place{0}, std::nullopt);
  builder.add_agent("right", Place{length - 1}, std::nullopt);
  int number = 0;
  for (const auto& [place, duration] : tasks)
    builder.add_task("t" + std::to_string(number++), place, Ids{"left", "right"}, duration, 1);
  return std::move(builder).build();
}

Ids visitors(const Session& session, const std::string& task) {
  Ids ids;
  const Instance& instance = session.instance();
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    for (const WorkTime& work : session.plan()->agents[i].work)
      if (instance.task(work.task).id == task) ids.push_back(instance.agent(i).id);
  return ids;
}

TEST(SessionWithChoices, AssignsTasksAndGoals) {
  for (const Instance& instance : {testing::instance_with_goals(), testing::instance_with_need()}) {
    Session session(instance);
    const Solution solution = replanned(session);
    ASSERT_TRUE(solution.plan);
    EXPECT_EQ(first_violation(instance, *solution.plan), "");
    EXPECT_EQ(solution.plan->cost, instance.task_count() == 0 ? 2 : 4);
    EXPECT_LE(solution.lower_bound, solution.plan->cost);
  }
}

TEST(SessionWithChoices, VisitedTaskIsRemoved) {
  Session session(corridor({{1, 0}, {5, 0}}));
  ASSERT_TRUE(replanned(session).plan);
  session.advance(1);
  EXPECT_EQ(session.instance().task_count(), 0);
  EXPECT_EQ(session.plan()->cost, 0);
}

TEST(SessionWithChoices, NeedFallsWithEachVisit) {
  InstanceBuilder builder(testing::grid_of({".......", "......."}));
  for (const Place start : {0, 6, 13}) builder.add_agent("a" + std::to_string(start), start, start);
  builder.add_task("t", Place{1}, Ids{"a0", "a6", "a13"}, 0, 2);
  Session session(std::move(builder).build());
  ASSERT_TRUE(replanned(session).plan);
  session.advance(1);
  ASSERT_EQ(session.instance().task_count(), 1);
  const Task& task = session.instance().task(0);
  EXPECT_EQ(task.need, 1);
  EXPECT_EQ(task.agents, (std::vector<AgentIndex>{1, 2}));
}

TEST(SessionWithChoices, AgentAtWorkIsBoundToItsTask) {
  Session session(corridor({{1, 4}}));
  ASSERT_TRUE(replanned(session).plan);
  session.advance(3);
  ASSERT_TRUE(session.instance().spec(0).working);
  EXPECT_EQ(session.instance().spec(0).working->done, 2);
  const Solution solution = replanned(session);
  EXPECT_EQ(solution.plan->cost, 2);
  EXPECT_EQ(visitors(session, "t0"), Ids{"left"});
}

// Two agents execute one task, of which one visit is enough. When one visit is done, the other
// agent stops.
TEST(SessionWithChoices, SurplusExecutionEndsWithTheNeed) {
  const Instance instance = [] {
    InstanceBuilder builder(testing::grid_of({"..."}));
    builder.add_agent("a", Place{0}, std::nullopt);
    builder.add_agent("b", Place{2}, std::nullopt);
    builder.add_task("at0", Place{0}, Ids{"a", "b"}, 2, 1);
    builder.add_task("at2", Place{2}, Ids{"a", "b"}, 4, 1);
    return std::move(builder).build();
  }();
  const Plan plan{6, {{2, {0}, {0, 0, 0}, {{0, 0, 2}}}, {4, {1}, {2, 2, 2, 2, 2}, {{1, 0, 4}}}}};
  ASSERT_EQ(first_violation(instance, plan), "");
  const Remainder rest = advance(instance, plan, 3);
  EXPECT_EQ(rest.instance.task_count(), 1);
  ASSERT_TRUE(rest.instance.spec(1).working);
  EXPECT_EQ(rest.plan.cost, 1);
  EXPECT_EQ(first_violation(rest.instance, rest.plan), "");
}

TEST(SessionWithChoices, NewTaskGoesToTheNearerAgent) {
  Session session(corridor({{1, 0}}));
  ASSERT_TRUE(replanned(session).plan);
  session.change({.new_tasks = {{.id = "new", .place = 4, .agents = {"left", "right"}, .need = 1}},
                  .dropped_tasks = {},
                  .blocked = {},
                  .closed_roads = {}});
  EXPECT_FALSE(session.plan());
  ASSERT_TRUE(replanned(session).plan);
  EXPECT_EQ(visitors(session, "t0"), Ids{"left"});
  EXPECT_EQ(visitors(session, "new"), Ids{"right"});
}

TEST(SessionWithChoices, NeedAboveTheNumberOfAgentsIsRefused) {
  Session session(corridor({}));
  InstanceChange change;
  change.new_tasks.push_back({.id = "new", .place = 4, .agents = {"left"}, .need = 2});
  try {
    session.change(change);
    FAIL();
  } catch (const InstanceError& error) {
    EXPECT_EQ(error.field(), "new_tasks/0/need");
  }
  EXPECT_EQ(session.instance().task_count(), 0);
}

TEST(SessionWithChoices, DroppedTaskFreesItsAgent) {
  Session session(corridor({{3, 0}}));
  ASSERT_TRUE(replanned(session).plan);
  InstanceChange change;
  change.dropped_tasks.push_back("t0");
  session.change(change);
  EXPECT_FALSE(session.plan());
  EXPECT_EQ(replanned(session).plan->cost, 0);
}

TEST(SessionWithChoices, ClosedGoalsAreRemovedWhileOneIsLeft) {
  Session session(testing::instance_with_goals());
  ASSERT_TRUE(replanned(session).plan);
  InstanceChange change;
  change.blocked.push_back(0);
  session.change(change);
  EXPECT_EQ(session.instance().agent(0).goals, std::vector<Place>{2});
  const Solution solution = replanned(session);
  ASSERT_TRUE(solution.plan);
  EXPECT_EQ(check(session.instance(), solution).size(), 0u);
  EXPECT_EQ(solution.plan->agents[0].path.back(), 2);
  change.blocked = {2};
  try {
    session.change(change);
    FAIL();
  } catch (const InstanceError& error) {
    EXPECT_STREQ(error.what(), "no goal of 'a0' is left");
  }
}

// Both agents are 3 steps from the task. However often the session re-plans, the task stays with
// the agent that has it.
TEST(SessionWithChoices, EqualAgentsDoNotExchangeTasks) {
  Session session(corridor({{3, 0}}));
  ASSERT_TRUE(replanned(session).plan);
  const Ids first = visitors(session, "t0");
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(replanned(session).plan->cost, 3);
    EXPECT_EQ(visitors(session, "t0"), first);
  }
}

// The right agent can visit both tasks at times 3 and 6, with cost 6. With an agent for each task
// the cost is 7, and the visits are at times 3 and 4.
TEST(SessionWithChoices, VisitWeightSpreadsTasks) {
  for (const int weight : {0, 10}) {
    Session session(corridor({{7, 0}, {4, 0}}, 11));
    ASSERT_TRUE(replanned(session, {}, 0, weight).plan);
    EXPECT_EQ(session.plan()->cost, weight == 0 ? 6 : 7);
    EXPECT_EQ(visitors(session, "t0"), Ids{"right"});
    EXPECT_EQ(visitors(session, "t1"), Ids{weight == 0 ? "right" : "left"});
  }
}

// The old plan gives the task to `left`; `right` is nearer. Without committed steps it changes
// hands. With committed steps in which `left` visits the task, it does not.
TEST(SessionWithChoices, CommittedVisitsStay) {
  const Instance instance = corridor({{2, 0}});
  const Plan plan{2, {{2, {0}, {0, 1, 2}, {{0, 2, 2}}}, {0, {}, {6}, {}}}};
  ASSERT_EQ(first_violation(instance, plan), "");
  Session session(instance, plan);
  const Solution solution = replanned(session, {}, 2);
  ASSERT_TRUE(solution.plan);
  EXPECT_EQ(solution.plan->agents[0].path, plan.agents[0].path);
  EXPECT_EQ(visitors(session, "t0"), Ids{"left"});
  EXPECT_FALSE(solution.stats.counts.contains("lower_bound_committed"));
}

TEST(SessionWithChoices, LimitKeepsTheOldPlan) {
  Session session(corridor({{2, 0}, {5, 0}}));
  const Cost cost = replanned(session).plan->cost;
  const Limits limits;
  limits.stop(StopReason::kTime);
  const Solution solution = session.solve(SolveOptions(), limits, nullptr, 0);
  ASSERT_TRUE(solution.plan);
  EXPECT_EQ(solution.plan->cost, cost);
}

// In the old plan `a` visits t2, t3 and t4 on its way, and rests on t0, which it has visited. A
// plan that ends on t1 costs less but visits t2, t3 and t4 later.
TEST(SessionWithChoices, VisitWeightAppliesToEndsOfTheOldPlan) {
  InstanceBuilder builder(testing::grid_of({".............."}));
  builder.add_agent("a", Place{3}, std::nullopt);
  builder.add_agent("b", Place{13}, std::nullopt);
  builder.add_task("t0", Place{3}, Ids{"a"});
  builder.add_task("t1", Place{2}, Ids{"a"});
  for (const char* id : {"t2", "t3", "t4"}) builder.add_task(id, Place{6}, Ids{"a", "b"}, 0, 1);
  const Instance instance = std::move(builder).build();
  const Plan plan{
      8,
      {{8, {0, 2, 3, 4, 1}, {3, 4, 5, 6, 5, 4, 3, 2, 3}, {{2, 3, 3}, {3, 3, 3}, {4, 3, 3}}},
       {0, {}, {13}, {}}}};
  ASSERT_EQ(first_violation(instance, plan), "");
  Session session(instance, plan);
  session.advance(0);
  const Solution solution = replanned(session, {}, 0, 10);
  ASSERT_TRUE(solution.plan);
  SolveOptions options;
  options.visit_weight = 10;
  EXPECT_LE(objective(*solution.plan, options), 8 + 10 * 9);
}

// The old plan makes more visits with one agent than an instance without choices can require.
TEST(SessionWithChoices, PlansWithVeryManyVisits) {
  constexpr Place kLength = 72;
  InstanceBuilder builder(testing::grid_of({std::string(kLength + 1, '.')}));
  builder.add_agent("a", Place{0}, std::nullopt);
  builder.add_agent("b", Place{kLength}, std::nullopt);
  Plan plan{kLength - 1, {{kLength - 1, {}, {0}, {}}, {0, {}, {kLength}, {}}}};
  for (Place place = 1; place < kLength; ++place) {
    builder.add_task("t" + std::to_string(place), place, Ids{"a", "b"}, 0, 1);
    plan.agents[0].sequence.push_back(place - 1);
    plan.agents[0].path.push_back(place);
    plan.agents[0].work.push_back({place - 1, place, place});
  }
  const Instance instance = std::move(builder).build();
  ASSERT_EQ(first_violation(instance, plan), "");
  for (const Time commit : {0, 68}) {
    Session session(instance, plan);
    const Solution solution = replanned(session, {}, commit);
    ASSERT_TRUE(solution.plan);
    EXPECT_LE(solution.plan->cost, plan.cost);
  }
}

TEST(SessionWithChoices, BetterAssignmentReplacesTheOldOne) {
  const Instance instance = corridor({{5, 0}});
  const Plan plan{5, {{5, {0}, {0, 1, 2, 3, 4, 5}, {{0, 5, 5}}}, {0, {}, {6}, {}}}};
  ASSERT_EQ(first_violation(instance, plan), "");
  Session session(instance, plan);
  EXPECT_EQ(replanned(session).plan->cost, 1);
  EXPECT_EQ(visitors(session, "t0"), Ids{"right"});
}

TEST(SessionWithChoices, DelaysKeepTheStatedVisits) {
  Session session(corridor({{2, 0}}));
  ASSERT_TRUE(replanned(session).plan);
  const std::vector<Delay> late{{0, 1}};
  session.advance(2, late);
  ASSERT_EQ(session.instance().task_count(), 1);
  EXPECT_EQ(session.plan()->cost, 1);
  EXPECT_EQ(visitors(session, "t0"), Ids{"left"});
}

TEST(SessionWithChoices, UnreachableTaskIsInfeasible) {
  InstanceBuilder builder(testing::grid_of({"..@."}));
  builder.add_agent("a", Place{0}, std::nullopt);
  builder.add_agent("b", Place{1}, std::nullopt);
  builder.add_task("t", Place{3}, Ids{"a", "b"}, 0, 1);
  Session session(std::move(builder).build());
  EXPECT_EQ(replanned(session).status, Status::kInfeasible);
}

Instance random_instance(std::uint64_t seed) {
  return with_random_choices(fuzz::any_instance(seed).build(), seed);
}

TEST(Advance, RemainderOfPlansWithChoicesIsValid) {
  int moments = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(300));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = random_instance(seed);
    if (!instance.has_choices()) continue;
    const auto plan = oracle::solve_jointly(instance, kStates).plan;
    if (!plan) continue;
    const Time end = std::ranges::max(plan->agents, {}, &AgentPlan::cost).cost;
    for (Time time = 0; time <= end + 1; ++time, ++moments) {
      const Remainder rest = advance(instance, *plan, time);
      ASSERT_EQ(first_violation(rest.instance, rest.plan), "") << "after " << time;
      EXPECT_LE(rest.plan.cost, plan->cost);
      const Remainder next =
          advance(rest.instance, rest.plan, 1, Rests::kAnywhere, rest.ends_with_plan);
      const Remainder both = advance(instance, *plan, time + 1);
      EXPECT_EQ(next.instance.task_count(), both.instance.task_count());
      EXPECT_EQ(next.plan.cost, both.plan.cost);
    }
    EXPECT_EQ(advance(instance, *plan, end).plan.cost, 0);
  }
  EXPECT_GT(moments, 300);
}

// The bound and the status hold for the current instance.
void expect_proven(const Instance& instance, const Solution& solution) {
  const oracle::Answer truth = oracle::solve_jointly(instance, kStates);
  if (truth.verdict == oracle::Verdict::kTooLarge) return;
  if (!truth.plan) {
    EXPECT_FALSE(solution.plan);
    return;
  }
  EXPECT_NE(solution.status, Status::kInfeasible);
  EXPECT_LE(solution.lower_bound, truth.plan->cost);
  if (solution.plan) {
    EXPECT_GE(solution.plan->cost, truth.plan->cost);
  }
}

// A remark on a bound "the cost is within omega of N, ..." is true. Omega is 0.
void expect_true_remark(const Solution& solution) {
  const auto remark = solution.stats.texts.find("remark");
  if (remark == solution.stats.texts.end() || !solution.plan) return;
  const std::string start = "the cost is within omega of ";
  if (!remark->second.starts_with(start)) return;
  EXPECT_EQ(std::stoll(remark->second.substr(start.size())), solution.plan->cost);
}

InstanceChange random_change(const Instance& instance, Random& random) {
  InstanceChange change = testing::random_change(instance, random);
  for (NewTask& task : change.new_tasks) {
    task.agents = instance.agent_ids();
    task.need = 1 + random.below(static_cast<int>(task.agents.size()));
  }
  return change;
}

void advance(Session& session, Time time, Random& random) {
  const std::vector<Delay> late = testing::random_delays(session.instance(), time, random);
  try {
    session.advance(time, late);
  } catch (const InfeasibleDelay&) {
    session.advance(time);
  }
  ASSERT_EQ(first_violation(session.instance(), *session.plan()), "");
}

TEST(SessionFuzz, ReplansInstancesWithChoices) {
  int plans = 0;
  int committed = 0;
  int optimal = 0;
  const int count = testing::fuzz_rounds(80);
  for (std::uint64_t seed = 1; static_cast<int>(seed) <= count; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Session session(random_instance(seed));
    if (!replanned(session, Omega::infinite()).plan) continue;
    for (int round = 0; round < 4 && session.plan(); ++round) {
      advance(session, random.below(6), random);
      if (HasFatalFailure()) return;
      const Time commit = random.below(3) == 0 ? random.below(4) : 0;
      const Plan old = *session.plan();
      bool changed = random.below(2) != 0;
      try {
        if (changed) session.change(random_change(session.instance(), random));
      } catch (const InstanceError&) {
        changed = false;
      }
      try {
        const Solution best =
            replanned(session, Omega(), commit, random.below(2) == 0 ? 0 : random.below(20));
        expect_proven(session.instance(), best);
        expect_true_remark(best);
        optimal += commit == 0 && best.status == Status::kOptimal;
        if (!changed) {
          ASSERT_TRUE(best.plan);  // the old plan remains possible
        }
        if (!best.plan) break;
        ASSERT_EQ(first_violation(session.instance(), *best.plan), "");
        ++plans;
        if (commit == 0 || changed) continue;
        ++committed;
        for (AgentIndex i = 0; i < session.instance().agent_count(); ++i)
          for (Time t = 0; t <= commit; ++t)
            ASSERT_EQ(state_at(best.plan->agents[i].path, t), state_at(old.agents[i].path, t));
      } catch (const Session::NotCommitted&) {
        break;
      }
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(plans, count);
  EXPECT_GT(committed, count / 16);
  EXPECT_GT(optimal, plans / 2);
}

TEST(SessionFuzz, ReplanningNeverRaisesTheCost) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(80));
       ++seed) {
    SCOPED_TRACE(seed);
    Session session(random_instance(seed));
    if (!replanned(session, Omega::infinite()).plan) continue;
    const Cost before = session.plan()->cost;
    const Solution solution = replanned(session);
    ASSERT_TRUE(solution.plan);
    EXPECT_LE(solution.plan->cost, before);
  }
}

}  // namespace session_choices_test
}  // namespace grove::detail
