// SPDX-License-Identifier: MIT
#include "engine/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "execution/advance.h"
#include "model/check.h"
#include "tests/engine/random_change.h"
#include "tests/execution/delays.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/clocks.h"
#include "tests/support/first_violation.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace session_test {

using testing::AgentSpec;
using testing::first_violation;
using testing::instance_of;

constexpr std::int64_t kLimitChecks = 10'000;  // limit on clock readings per solve

SolveOptions with_omega(Omega omega) {
  SolveOptions options;
  options.omega = omega;
  return options;
}

Solution solved(Session& session, Omega omega, Time commit = 0) {
  return session.solve(with_omega(omega), testing::ClockReadingLimit(kLimitChecks), nullptr,
                       commit);
}

Session session_of(const Instance& instance) {
  Session session(instance);
  solved(session, Omega());
  return session;
}

TEST(Session, AdvancesAlongItsPlan) {
  Session session = session_of(instance_of(
      {"....."}, {AgentSpec{{0, 0}, Position{4, 0}, {Position{1, 0}, Position{3, 0}}}}));
  ASSERT_TRUE(session.plan());
  session.advance(2);
  EXPECT_EQ(session.instance().task_count(), 1);
  EXPECT_EQ(session.plan()->cost, 2);
  EXPECT_EQ(solved(session, Omega()).plan->cost, 2);
}

TEST(Session, DelayedAgentIsBehindItsPlan) {
  Session session = session_of(instance_of(
      {"......"}, {AgentSpec{{0, 0}, Position{4, 0}, {}}, AgentSpec{{1, 0}, Position{5, 0}, {}}}));
  // Agent 1 blocks agent 0, so a delay of agent 1 also delays agent 0.
  const Delay late{1, 2};
  session.advance(3, {&late, 1});
  const Grid& grid = session.instance().grid();
  EXPECT_EQ(session.instance().agent(1).start, grid.cell({2, 0}));
  EXPECT_EQ(session.instance().agent(0).start, grid.cell({1, 0}));
  EXPECT_EQ(first_violation(session.instance(), *session.plan()), "");
}

TEST(Session, DelayOfZeroStepsChangesNothing) {
  const Instance instance = instance_of({"...", "#.#"}, {AgentSpec{{0, 0}, Position{2, 0}, {}},
                                                         AgentSpec{{1, 1}, Position{1, 1}, {}}});
  Plan waits = *session_of(instance).plan();
  AgentPlan& first = waits.agents[0];
  first.path.insert(first.path.begin(), first.path.front());
  ++first.cost;
  ++waits.cost;
  Session session(instance, waits);
  const Delay late{0, 0};
  session.advance(0, {&late, 1});
  EXPECT_EQ(session.plan()->agents[0].path, first.path);
}

TEST(Session, InfeasibleDelayIsRefused) {
  Session session = session_of(instance_of(
      {"......"}, {AgentSpec{{0, 0}, Position{4, 0}, {}}, AgentSpec{{1, 0}, Position{5, 0}, {}}}));
  const Delay late[] = {{1, 3}, {0, 1}};
  const Plan before = *session.plan();
  EXPECT_THROW(session.advance(3, late), InfeasibleDelay);
  EXPECT_EQ(session.plan()->cost, before.cost);
  EXPECT_EQ(session.instance().agent(0).start, session.instance().grid().cell({0, 0}));
}

TEST(Session, ReplansAroundAClosedCell) {
  Session session =
      session_of(instance_of({".....", "....."}, {AgentSpec{{0, 0}, Position{4, 0}, {}}}));
  InstanceChange change;
  change.blocked = {session.instance().grid().cell({2, 0})};
  session.change(change);
  EXPECT_FALSE(session.plan());
  const Solution solution = solved(session, Omega());
  EXPECT_EQ(solution.plan->cost, 6);
  EXPECT_EQ(first_violation(session.instance(), solution), "");
}

TEST(Session, CommittedStepsCannotBeClosed) {
  Session session =
      session_of(instance_of({".....", "....."}, {AgentSpec{{0, 0}, Position{4, 0}, {}}}));
  InstanceChange change;
  change.blocked = {session.instance().grid().cell({2, 0})};
  session.change(change);
  try {
    solved(session, Omega(), 3);
    FAIL();
  } catch (const Session::NotCommitted& error) {
    EXPECT_EQ(error.agent, 0);
    EXPECT_EQ(error.steps, 1);
  }
  EXPECT_EQ(solved(session, Omega(), 1).plan->cost, 6);
}

TEST(Session, InvalidChangeLeavesTheSessionUnchanged) {
  Session session =
      session_of(instance_of({"....."}, {AgentSpec{{0, 0}, Position{4, 0}, {Position{2, 0}}}}));
  InstanceChange standing;
  standing.blocked = {0};
  EXPECT_THROW(session.change(standing), InstanceError);
  InstanceChange task;
  task.blocked = {2};
  EXPECT_THROW(session.change(task), InstanceError);
  InstanceChange unknown;
  unknown.dropped_tasks = {"unknown"};
  EXPECT_THROW(session.change(unknown), InstanceError);
  ASSERT_TRUE(session.plan());
  EXPECT_EQ(session.plan()->cost, 4);
}

TEST(Session, DelayKeepsTheRuleWithoutFollowing) {
  Session session = session_of(instance_of({"......."}, {AgentSpec{{0, 0}, Position{4, 0}, {}},
                                                         AgentSpec{{2, 0}, Position{6, 0}, {}}})
                                   .without_following());
  const Delay late{1, 2};
  session.advance(3, {&late, 1});
  EXPECT_EQ(first_violation(session.instance(), *session.plan()), "");
  for (const Time commit : {0, 2}) {
    const Solution solution = solved(session, Omega(), commit);
    EXPECT_TRUE(solution.plan);
    EXPECT_EQ(first_violation(session.instance(), solution), "");
  }
}

TEST(Session, DelayBeyondTheStartIsRefused) {
  Session session = session_of(instance_of({"....."}, {AgentSpec{{0, 0}, Position{4, 0}, {}}}));
  const Delay beyond{0, 3};
  EXPECT_THROW(session.advance(2, {&beyond, 1}), InfeasibleDelay);
  const Delay twice[] = {{0, 1}, {0, 1}};
  EXPECT_THROW(session.advance(2, twice), InfeasibleDelay);
  EXPECT_EQ(session.instance().agent(0).start, 0);
}

// A robot that starts in the middle of a task, with 1 of 5 steps completed.
Instance working_robot() {
  InstanceBuilder builder(testing::grid_of({"...."}));
  detail::AgentSpec spec{.id = "a", .start = {.place = 0}, .goal = 3};
  spec.working = WorkBegun{"press", 1};
  builder.add_agent(spec);
  builder.add_task("press", Position{0, 0}, std::vector<std::string>{"a"}, 5);
  return std::move(builder).build();
}

TEST(Session, DelayAppliesToWorkBegunBeforeTheStart) {
  for (const Time steps : {0, 1, 2, 3}) {
    Session session = session_of(working_robot());
    const Delay late{0, steps};
    session.advance(3, {&late, 1});
    const auto working = session.instance().spec(0).working;
    ASSERT_TRUE(working) << steps;
    EXPECT_EQ(working->done, 4 - steps);
    EXPECT_EQ(session.plan()->cost, 4 + steps);
    EXPECT_EQ(solved(session, Omega()).plan->cost, 4 + steps);
  }
  // Without the delay the robot would have completed the task by then.
  Session session = session_of(working_robot());
  const Delay late{0, 4};
  session.advance(6, {&late, 1});
  EXPECT_EQ(session.instance().spec(0).working->done, 3);
}

// A session in which, after one step, the agent's only remaining task is at the end of the row,
// while the old plan still returns to the start. With `other`, a second agent ends on the cell of
// that task.
Session returning_session(bool other) {
  std::vector<AgentSpec> agents{{{2, 0}, std::nullopt, {Position{2, 0}, Position{4, 0}}}};
  if (other) agents.push_back({{0, 1}, Position{4, 0}, {}});
  const Instance instance = instance_of({".....", "....."}, agents);
  const Grid& grid = instance.grid();
  const auto path = [&](std::vector<Position> positions) {
    Path cells;
    for (const Position p : positions) cells.push_back(grid.cell(p));
    return cells;
  };
  Plan plan{4, {{4, {1, 0}, path({{2, 0}, {3, 0}, {4, 0}, {3, 0}, {2, 0}})}}};
  if (other) {
    plan.agents.push_back({5, {}, path({{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}, {4, 0}})});
    plan.cost += 5;
  }
  return Session(instance, plan);
}

TEST(Session, AgentWithoutDestinationEndsOnAnyRemainingTask) {
  Session session = returning_session(false);
  session.advance(1);
  ASSERT_TRUE(session.plan());
  EXPECT_EQ(first_violation(session.instance(), *session.plan()), "");
  const Solution solution = solved(session, Omega());
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_EQ(solution.plan->cost, 1);
  EXPECT_FALSE(session.instance().agent(0).goal);
  EXPECT_FALSE(solution.stats.texts.contains("ends_of_old_plan"));
}

// If the agent cannot end on any of its remaining tasks, it ends where the old plan ends, and the
// statistics report this.
TEST(Session, EndOfTheOldPlanIsKeptIfNoOtherIsFree) {
  for (const Time commit : {0, 1}) {
    Session session = returning_session(true);
    session.advance(1);
    const Solution solution = solved(session, Omega(), commit);
    ASSERT_TRUE(solution.plan);
    EXPECT_EQ(solution.plan->cost, 3 + 4);
    EXPECT_EQ(first_violation(session.instance(), solution), "");
    EXPECT_EQ(solution.stats.texts.at("ends_of_old_plan"), "a0");
    EXPECT_EQ(session.instance().agent(0).goal, 2);
    session.advance(1);
    EXPECT_TRUE(session.instance().agent(0).is_idle());  // after all its tasks have been visited
  }
}

TEST(Session, AgentMayEndOnItsNewTask) {
  Session session = returning_session(true);
  session.advance(1);
  InstanceChange change;
  change.new_tasks.push_back({"new", session.instance().grid().cell({4, 1}), {"a0"}});
  session.change(change);
  const Solution solution = solved(session, Omega());
  ASSERT_TRUE(solution.plan);
  EXPECT_FALSE(session.instance().agent(0).goal);
  EXPECT_EQ(first_violation(session.instance(), solution), "");
}

TEST(Session, ObstaclesCannotBeClosed) {
  Session session =
      session_of(instance_of({"..@", "..."}, {AgentSpec{{0, 0}, Position{0, 1}, {}}}));
  InstanceChange change;
  change.blocked = {2};
  EXPECT_THROW(session.change(change), InstanceError);
  EXPECT_TRUE(session.plan());
}

TEST(Session, SolvesFromScratchWithoutAPlan) {
  Session session(instance_of({"....."}, {AgentSpec{{0, 0}, Position{4, 0}, {}}}));
  InstanceChange change;
  change.new_tasks.push_back({"t", 1, {session.instance().agent(0).id}});
  session.change(change);
  const Solution solution = solved(session, Omega());
  ASSERT_TRUE(solution.plan);
  EXPECT_EQ(solution.plan->agents[0].sequence.size(), 1u);
}

// The old instance and plan. A new plan must keep the first `steps` steps of the old one.
struct Kept {
  Instance instance;
  Plan plan;
  Time steps;
  bool work_is_dropped = false;
};

void expect_kept(const Kept& kept, const Plan& plan, std::uint64_t seed) {
  for (AgentIndex agent = 0; agent < kept.instance.agent_count(); ++agent)
    for (Time t = 0; t <= kept.steps; ++t)
      ASSERT_EQ(state_at(plan.agents[agent].path, t), state_at(kept.plan.agents[agent].path, t))
          << seed << ": agent " << agent << " at " << t;
}

bool same_actions(const ActionDependencyGraph& before, const ActionDependencyGraph& after,
                  Time steps) {
  for (AgentIndex robot = 0; robot < before.agent_count(); ++robot)
    for (ActionIndex a = before.begin_of(robot); a < before.end_of(robot); ++a) {
      const ActionIndex same = after.begin_of(robot) + a - before.begin_of(robot);
      if (before.actions()[a].begin >= steps) break;
      if (same >= after.end_of(robot) || after.actions()[same].kind != before.actions()[a].kind ||
          after.actions()[same].begin != before.actions()[a].begin)
        return false;
    }
  return true;
}

// Executes the committed actions of the old action dependency graph with random delays, and expects
// that every state during this execution also agrees with the new graph.
void expect_safe(const Kept& kept, const Instance& now, const Plan& plan, std::uint64_t seed) {
  const ActionDependencyGraph before(kept.instance, kept.plan);
  const ActionDependencyGraph after(now, plan);
  if (!same_actions(before, after, kept.steps)) {
    ASSERT_TRUE(kept.work_is_dropped) << seed;
    return;
  }
  testing::Delays delays(before, seed);
  const auto is_committed = [&](ActionIndex a) { return before.actions()[a].begin < kept.steps; };
  const ExecutionTrace executed = simulate(before, [&](ActionIndex a, Time begin) {
    return is_committed(a) ? delays(a, begin) : kNever;
  });
  for (Time moment = 0; moment < 50; moment += 1 + moment / 4) {
    const auto is_done = [&](ActionIndex a) {  // `a`: an action of the new graph
      const AgentIndex robot = after.actions()[a].agent;
      const ActionIndex same = before.begin_of(robot) + a - after.begin_of(robot);
      return same < before.end_of(robot) && is_committed(same) && executed.end[same] <= moment;
    };
    for (std::int32_t step = 0; step < after.step_count(); ++step)
      for (const ActionIndex a : after.step(step)) {
        if (!is_done(a)) continue;
        ASSERT_TRUE(after.after(a) == kNoAction || is_done(after.after(a))) << seed;
        for (const ActionIndex member : after.step(step)) ASSERT_TRUE(is_done(member)) << seed;
      }
  }
}

Instance random_instance(std::uint64_t seed) {
  fuzz::TinyInstance tiny = fuzz::random_world(seed);
  tiny.may_follow = seed % 3 != 0;
  return tiny.build();
}

// Advances the session, then checks the plan and the states of delayed robots.
void advance_and_check(Session& session, Time time, Random& random) {
  const Instance before = session.instance();
  const Plan plan = *session.plan();
  std::vector<Delay> late = testing::random_delays(before, time, random);
  try {
    session.advance(time, late);
  } catch (const InfeasibleDelay&) {
    late.clear();
    session.advance(time);
  }
  ASSERT_EQ(first_violation(session.instance(), *session.plan()), "");
  ASSERT_EQ(session.instance().may_follow(), before.may_follow());
  for (const Delay& l : late) {
    const detail::AgentSpec then = advance(before, plan, time - l.steps).instance.spec(l.agent);
    const detail::AgentSpec now = session.instance().spec(l.agent);
    ASSERT_EQ(now.start, then.start) << now.id;
    ASSERT_EQ(now.working.has_value(), then.working.has_value()) << now.id;
    if (now.working) {
      ASSERT_EQ(now.working->task, then.working->task);
      ASSERT_EQ(now.working->done, then.working->done);
    }
  }
}

// Expects that the proven bound and the status hold for the current instance. Returns 1 if the
// oracle decided the instance, otherwise 0.
int expect_proven(const Instance& instance, const Solution& solution) {
  const oracle::Answer truth = oracle::solve_jointly(instance, 100'000);
  if (truth.verdict == oracle::Verdict::kTooLarge) return 0;
  if (truth.verdict == oracle::Verdict::kInfeasible) {
    EXPECT_FALSE(solution.plan);
    return 1;
  }
  EXPECT_NE(solution.status, Status::kInfeasible);
  EXPECT_LE(solution.lower_bound, truth.plan->cost);
  if (solution.plan) {
    EXPECT_GE(solution.plan->cost, truth.plan->cost);
  }
  return 1;
}

TEST(SessionFuzz, EveryAnswerIsValidAndKeepsTheCommittedSteps) {
  int changes = 0;
  int committed = 0;
  int proven = 0;
  int ends = 0;
  const int count = testing::fuzz_rounds(100);
  for (std::uint64_t seed = 1; static_cast<int>(seed) <= count; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Session session(random_instance(seed));
    if (!solved(session, Omega::infinite()).plan) continue;
    for (int round = 0; round < 4 && session.plan(); ++round) {
      advance_and_check(session, random.below(6), random);
      if (HasFatalFailure()) return;
      const Time commit = static_cast<Time>(random.below(3) == 0 ? random.below(4) : 0);
      Kept kept{session.instance(), *session.plan(), commit};
      bool changed = random.below(3) != 0;
      try {
        const InstanceChange change = testing::random_change(session.instance(), random);
        if (changed) session.change(change);
        kept.work_is_dropped = changed && !change.dropped_tasks.empty();
      } catch (const InstanceError&) {
        changed = false;
      }
      try {
        const Solution best = solved(session, Omega(), commit);
        proven += expect_proven(session.instance(), best);
        if (!changed) {
          ASSERT_TRUE(best.plan);
          ASSERT_LE(best.plan->cost, kept.plan.cost);  // the old plan remains possible
        }
        ends += static_cast<int>(best.stats.texts.count("ends_of_old_plan"));
        if (!best.plan) break;
        ++changes;
        ASSERT_EQ(first_violation(session.instance(), best), "");
        if (commit == 0) continue;
        ++committed;
        if (best.stats.counts.contains("lower_bound_committed")) {
          ASSERT_LE(best.stats.counts.at("lower_bound_committed"), best.plan->cost);
        }
        if (!changed || kept.instance.is_on_grid()) expect_kept(kept, *best.plan, seed);
        expect_safe(kept, session.instance(), *best.plan, seed);
      } catch (const Session::NotCommitted&) {
        break;
      }
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(changes, count);
  EXPECT_GT(committed, count / 8);
  EXPECT_GT(proven, count);
  RecordProperty("ends_of_old_plan", ends);
}

// The bound is proven for plans that start with the committed steps. In most instances the plan
// found reaches it.
TEST(SessionFuzz, BoundGivenTheCommittedStepsIsMostlyReached) {
  int optimal = 0;
  for (std::uint64_t seed = 1000; seed < 1100; ++seed) {
    Session session(random_instance(seed));
    if (!solved(session, Omega::infinite()).plan) continue;
    const Solution solution = solved(session, Omega(), 2);
    ASSERT_TRUE(solution.plan) << seed;
    ASSERT_EQ(first_violation(session.instance(), solution), "") << seed;
    if (!solution.stats.counts.contains("lower_bound_committed")) continue;
    const Cost bound = solution.stats.counts.at("lower_bound_committed");
    ASSERT_LE(bound, solution.plan->cost) << seed;
    optimal += bound == solution.plan->cost ? 1 : 0;
  }
  EXPECT_GT(optimal, 50);
}

}  // namespace session_test
}  // namespace grove::detail
