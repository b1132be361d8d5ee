// SPDX-License-Identifier: MIT
// Tests the public C++ API as users see it: of the library's headers it includes only
// <grove/grove.hpp>.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <concepts>
#include <fstream>
#include <functional>
#include <future>
#include <limits>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "grove/grove.hpp"
#include "tests/support/temporary_directory.h"

namespace grove {
namespace api_test {

using detail::TemporaryDirectory;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::vector<std::string> kRows{".....", ".@.@.", "....."};

Instance small() {
  return Instance(World::from_rows(kRows),
                  {{.id = "red", .start = {Cell{0, 0}}, .goal = Cell{4, 2}},
                   {.id = "blue", .start = {Cell{4, 0}}, .goal = Cell{0, 2}}},
                  {{.id = "press", .place = Cell{2, 1}, .agents = {"red", "blue"}, .duration = 3},
                   {.id = "look", .place = Cell{2, 0}, .agents = {"red"}}});
}

// Robots that must pass each other in a corridor two cells wide. The search takes hours.
Instance dense_instance(int robots = 14) {
  std::vector<Agent> agents;
  for (int i = 0; i < robots; ++i)
    agents.push_back(
        {.id = "r" + std::to_string(i), .start = {Cell{i, 0}}, .goal = Cell{robots - 1 - i, 1}});
  return Instance(World::grid(robots, 2, std::vector<bool>(2 * robots, true)), agents, {});
}

std::string field_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InvalidArgument& error) {
    return error.field();
  } catch (const std::exception& error) {
    return std::string("another exception: ") + error.what();
  }
  return "nothing thrown";
}

TEST(Api, SolvesAndChecks) {
  const Instance instance = small();
  const Solution solution = solve(instance);
  ASSERT_EQ(solution.status, Status::optimal);
  ASSERT_TRUE(solution.plan);
  EXPECT_EQ(solution.plan->cost, solution.lower_bound);
  EXPECT_EQ(solution.gap(), 0.0);
  EXPECT_THAT(check(instance, solution), IsEmpty());
  EXPECT_THAT(check(instance, *solution.plan), IsEmpty());
  const AgentPlan& red = solution.plan->agents[0];
  EXPECT_EQ(red.id, "red");
  EXPECT_EQ(red.path.front(), (Pose{Cell{0, 0}}));
  EXPECT_EQ(solution.plan->pose(0, 1'000'000), (Pose{Cell{4, 2}}));
  EXPECT_THAT(red.tasks, ::testing::UnorderedElementsAre("press", "look"));
  ASSERT_EQ(red.work.size(), 1u);
  EXPECT_EQ(red.work[0].end - red.work[0].begin, 3);
  EXPECT_GT(solution.counts.at("nodes_expanded"), 0);
  EXPECT_GE(solution.measures.at("wall_s"), 0);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
static_assert(std::same_as<Delay, Delay>, "the old name");
#pragma GCC diagnostic pop

TEST(Api, CheckFindsViolations) {
  const Instance instance = small();
  Solution solution = solve(instance);
  Plan wrong = *solution.plan;
  wrong.agents[0].path[1].place = Cell{4, 2};
  const std::vector<Violation> violations = check(instance, wrong);
  ASSERT_FALSE(violations.empty());
  EXPECT_THAT(violations[0].json_pointer, ::testing::StartsWith("/agents/0/"));
  EXPECT_EQ(violations[0].place, violations[0].json_pointer) << "the old name";
  solution.lower_bound = solution.plan->cost + 1;
  EXPECT_FALSE(check(instance, solution).empty());
  wrong.agents[0].path[1].place = Cell{9, 9};
  EXPECT_EQ(field_of([&] { check(instance, wrong); }), "/agents/0/path/1");
  EXPECT_EQ(field_of([&] { check(instance, Plan{}); }), "/agents");
}

TEST(Api, InstancesRoundTripThroughFiles) {
  const World hall = World::roadmap({{"A", 0, 0}, {"B", 4, 0}, {"C", 4, 3}, {"D", 6, 0}},
                                    {{.from = "A", .to = "B", .steps = 4},
                                     {.from = "B", .to = "C", .steps = 3, .one_way = true},
                                     {.from = "B", .to = "D", .steps = 1}});
  const Instance roads(hall,
                       {{.id = "r", .start = {OnRoad{"A", "B", 1}}, .goal = Vertex{"C"}},
                        {.id = "idle", .start = {Vertex{"B"}}}},
                       {});
  EXPECT_EQ(roads.agents()[0].start, (Pose{OnRoad{"A", "B", 1}}));
  const Solution solution = solve(roads);
  ASSERT_TRUE(solution.plan);
  EXPECT_EQ(solution.plan->pose(0, 1), (Pose{OnRoad{"A", "B", 2}}));
  EXPECT_EQ(hall.edges()[1].one_way, true);
  EXPECT_EQ(hall.vertices()[2].y, 3);

  const Instance turning(World::from_rows(kRows),
                         {{.id = "t",
                           .start = {Cell{0, 0}, Heading::north, Heading::east, 1},
                           .goal = Cell{2, 0},
                           .turn_steps = 2,
                           .goal_heading = Heading::south}},
                         {{.id = "w", .place = Cell{1, 0}, .agents = {"t"}, .duration = 2}},
                         {.following = false});
  TemporaryDirectory directory;
  for (const Instance& instance : {roads, turning, small()}) {
    write_instance(directory / "i.cts.json", instance);
    const Instance restored = read_instance(directory / "i.cts.json");
    ASSERT_EQ(restored.agents().size(), instance.agents().size());
    for (std::size_t i = 0; i < instance.agents().size(); ++i) {
      EXPECT_EQ(restored.agents()[i].id, instance.agents()[i].id);
      EXPECT_EQ(restored.agents()[i].start, instance.agents()[i].start);
      EXPECT_EQ(restored.agents()[i].goal, instance.agents()[i].goal);
      EXPECT_EQ(restored.agents()[i].turn_steps, instance.agents()[i].turn_steps);
      EXPECT_EQ(restored.agents()[i].goal_heading, instance.agents()[i].goal_heading);
    }
    ASSERT_EQ(restored.tasks().size(), instance.tasks().size());
    for (std::size_t i = 0; i < instance.tasks().size(); ++i) {
      EXPECT_EQ(restored.tasks()[i].place, instance.tasks()[i].place);
      EXPECT_EQ(restored.tasks()[i].duration, instance.tasks()[i].duration);
      EXPECT_EQ(restored.tasks()[i].agents, instance.tasks()[i].agents);
    }
    EXPECT_EQ(
        solve(restored).lower_bound,
        solve(Instance(instance.world(), instance.agents(), instance.tasks(), {})).lower_bound);
  }
  EXPECT_FALSE(turning.rules().following);
}

TEST(Api, InstancesRoundTripAsTextWithAGivenWorld) {
  const Instance instance = small();
  const Instance restored =
      parse_instance(instance_text(instance), instance.world(), {.following = false});
  EXPECT_EQ(instance_text(restored), instance_text(instance));
  EXPECT_THAT(instance_text(instance), Not(HasSubstr("map")));
  EXPECT_FALSE(restored.rules().following);
  EXPECT_THROW(parse_instance(R"({"agents": [{"id": "r", "start": [1, 1]}], "tasks": []})",
                              instance.world()),
               InputError);
}

TEST(Api, PlanFromPathsFindsCostAndTasks) {
  const Instance instance(World::from_rows(kRows),
                          {{.id = "red", .start = {Cell{0, 0}}, .goal = Cell{2, 0}}},
                          {{.id = "far", .place = Cell{3, 0}, .agents = {"red"}},
                           {.id = "near", .place = Cell{1, 0}, .agents = {"red"}}});
  const std::vector<Place> path{Cell{0, 0}, Cell{1, 0}, Cell{2, 0},
                                Cell{3, 0}, Cell{2, 0}, Cell{2, 0}};  // rests at the end
  const Plan plan = plan_from_paths(instance, {path});
  EXPECT_EQ(plan.cost, 4);
  EXPECT_THAT(plan.agents[0].tasks, ElementsAre("near", "far"));
  EXPECT_THAT(check(instance, plan), IsEmpty());
  EXPECT_EQ(field_of([&] { plan_from_paths(instance, {path, path}); }), "/agents");
  EXPECT_EQ(field_of([&] {
              plan_from_paths(instance, {{Cell{0, 0}, Cell{9, 9}}});
            }),
            "/agents/0/path/1");
  EXPECT_EQ(field_of([&] { plan_from_paths(small(), {path, path}); }), "/work");
}

// One of three agents must look; red may end on either of two cells.
Instance with_choices() {
  return Instance(
      World::from_rows(kRows),
      {{.id = "red", .start = {Cell{0, 0}}, .goals = {Cell{4, 2}, Cell{2, 0}}},
       {.id = "blue", .start = {Cell{4, 0}}, .goal = Cell{4, 0}},
       {.id = "idle", .start = {Cell{4, 2}}}},
      {{.id = "look", .place = Cell{1, 0}, .need = 1, .all_agents = true},
       {.id = "push", .place = Cell{2, 0}, .agents = {"red", "blue"}, .duration = 2, .need = 1}});
}

Plan plan_with_choices() {
  const std::vector<Place> red{Cell{0, 0}, Cell{1, 0}, Cell{2, 0}};
  return plan_from_paths(with_choices(), {red, {Cell{4, 0}}, {Cell{4, 2}}},
                         {{{"look", 1, 1}, {"push", 2, 4}}, {}, {}});
}

TEST(Api, InstancesHaveChoices) {
  const Instance instance = with_choices();
  EXPECT_TRUE(instance.has_choices());
  EXPECT_FALSE(small().has_choices());
  EXPECT_THAT(instance.tasks()[0].agents, ElementsAre("red", "blue", "idle"));
  const Instance again = parse_instance(instance_text(instance), instance.world());
  EXPECT_EQ(instance_text(again), instance_text(instance));
  EXPECT_THAT(again.agents()[0].goals, ElementsAre(Place(Cell{4, 2}), Place(Cell{2, 0})));
  EXPECT_EQ(again.agents()[0].goal, std::nullopt);
  EXPECT_EQ(again.tasks()[0].need, 1);
  EXPECT_TRUE(again.tasks()[0].all_agents);
  EXPECT_THAT(again.tasks()[0].agents, ElementsAre("red", "blue", "idle"));
  EXPECT_EQ(again.tasks()[1].need, 1);
  EXPECT_FALSE(again.tasks()[1].all_agents);
  const Instance rebuilt(again.world(), again.agents(), again.tasks());
  EXPECT_EQ(instance_text(rebuilt), instance_text(instance));
  EXPECT_EQ(small().tasks()[0].need, std::nullopt);
}

TEST(Api, BadChoicesAreRefused) {
  const auto field = [](std::vector<Place> goals, std::optional<Place> goal, Task task) {
    return field_of([&] {
      Instance(World::from_rows(kRows),
               {{.id = "red", .start = {Cell{0, 0}}, .goal = goal, .goals = goals}}, {task});
    });
  };
  const Task task{.id = "t", .place = Cell{1, 0}, .agents = {"red"}};
  EXPECT_EQ(field({Cell{1, 1}}, {}, task), "/agents/0/goals/0");
  EXPECT_EQ(field({Cell{0, 0}, Cell{9, 9}}, {}, task), "/agents/0/goals/1");
  EXPECT_EQ(field({Cell{0, 0}, Cell{0, 0}}, {}, task), "/agents/0/goals/1");
  EXPECT_EQ(field({Cell{0, 0}}, Cell{2, 0}, task), "/agents/0/goals");
  for (const int need : {-1, 0, 2}) {
    Task other = task;
    other.need = need;
    EXPECT_EQ(field({}, {}, other), "/tasks/0/need") << need;
  }
  Task none = task;
  none.agents.clear();
  EXPECT_EQ(field({}, {}, none), "/tasks/0/agents");
  Task both = task;
  both.all_agents = true;
  EXPECT_EQ(field({}, {}, both), "nothing thrown");
  both.agents = {"green"};
  EXPECT_EQ(field({}, {}, both), "/tasks/0/agents");
}

TEST(Api, PlansTellVisits) {
  const Instance instance = with_choices();
  const Plan plan = plan_with_choices();
  EXPECT_EQ(plan.cost, 4);
  EXPECT_THAT(plan.agents[0].tasks, ElementsAre("look", "push"));
  ASSERT_EQ(plan.agents[0].work.size(), 2u);
  EXPECT_EQ(plan.agents[0].work[0].begin, 1);
  EXPECT_EQ(plan.agents[0].work[0].end, 1);
  EXPECT_THAT(check(instance, plan), IsEmpty());
  Solution solution{.status = Status::optimal, .plan = plan, .lower_bound = 4};
  const std::string text = plan_text(instance, solution);
  EXPECT_EQ(plan_text(instance, parse_plan(text, instance)), text);
  Plan untold = plan;
  untold.agents[0].work.erase(untold.agents[0].work.begin());
  untold.agents[0].tasks = {"push"};
  const std::vector<Violation> wrong = check(instance, untold);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_EQ(wrong[0].message, "task 'look' is visited by 0 of its agents; expected at least 1");
}

TEST(Api, PlansFromPathsNeedTheStatedVisits) {
  const std::vector<std::vector<Place>> paths{{Cell{0, 0}}, {Cell{4, 0}}, {Cell{4, 2}}};
  EXPECT_EQ(field_of([&] { plan_from_paths(with_choices(), paths); }), "/work");
  EXPECT_EQ(field_of([&] { plan_from_paths(with_choices(), paths, {{}, {}}); }), "/work");
  EXPECT_EQ(field_of([&] {
              plan_from_paths(with_choices(), paths, {{}, {{"none", 0, 0}}, {}});
            }),
            "/work/1/0/task");
}

TEST(Api, ChoicesAreSolvedAndReplanned) {
  const Instance instance = with_choices();
  const Solution solution = solve(instance);
  ASSERT_TRUE(solution.plan);
  EXPECT_EQ(check(instance, *solution.plan).size(), 0u);
  EXPECT_EQ(field_of([&] { solve(instance, {.method = "mgcbs"}); }), "/method");
  Session session(instance, plan_with_choices());
  session.advance(3);  // red has looked, and pushes
  ASSERT_EQ(session.instance().tasks().size(), 1u);
  ASSERT_TRUE(session.instance().agents()[0].working);
  EXPECT_EQ(session.instance().agents()[0].working->done, 1);
  session.change(
      {.new_tasks = {{.id = "new", .place = Cell{4, 1}, .need = 1, .all_agents = true}}});
  EXPECT_FALSE(session.plan());
  EXPECT_EQ(session.instance().tasks().back().need, 1);
  const Solution again = session.replan({.omega = 0, .visit_weight = 10});
  ASSERT_TRUE(again.plan);
  EXPECT_EQ(check(session.instance(), again).size(), 0u);
  EXPECT_LE(again.lower_bound, again.plan->cost);
  for (const int weight : {-1, 101})
    EXPECT_EQ(field_of([&] { session.replan({.visit_weight = weight}); }), "/visit_weight");
}

TEST(Api, NewTasksOfASessionHaveANeed) {
  Session session(small());
  Task task{.id = "new", .place = Cell{1, 0}, .agents = {"red", "blue"}, .need = 3};
  EXPECT_EQ(field_of([&] { session.change({.new_tasks = {task}}); }), "/new_tasks/0/need");
  task.need = 1;
  EXPECT_EQ(field_of([&] { session.change({.new_tasks = {task}}); }), "nothing thrown");
  EXPECT_TRUE(session.instance().has_choices());
  EXPECT_EQ(
      field_of([&] {
        session.change({.new_tasks = {{.id = "all", .place = Cell{1, 0}, .all_agents = true}}});
      }),
      "nothing thrown");
  EXPECT_THAT(session.instance().tasks().back().agents, ElementsAre("red", "blue"));
}

TEST(Api, ChoicesAreFixed) {
  const FixedChoices fixed = fix_choices(with_choices(), plan_with_choices());
  EXPECT_FALSE(fixed.instance.has_choices());
  EXPECT_EQ(check(fixed.instance, fixed.plan).size(), 0u);
  EXPECT_EQ(fixed.plan.cost, 4);
  EXPECT_EQ(fixed.instance.agents()[0].goal, Place(Cell{2, 0}));
  for (const Task& task : fixed.instance.tasks()) EXPECT_THAT(task.agents, ElementsAre("red"));
  Plan wrong = plan_with_choices();
  ++wrong.cost;
  EXPECT_EQ(field_of([&] { fix_choices(with_choices(), wrong); }), "/cost");
}

TEST(Api, PlansRoundTripThroughFiles) {
  const Instance instance = small();
  const Solution solution = solve(instance, {.omega = 0.5});
  TemporaryDirectory directory;
  write_plan(directory / "p.json", instance, solution);
  const Solution restored = read_plan(directory / "p.json", instance);
  EXPECT_EQ(plan_text(instance, restored), plan_text(instance, solution));
  EXPECT_EQ(plan_text(instance, parse_plan(plan_text(instance, solution), instance)),
            plan_text(instance, solution));
  EXPECT_EQ(restored.omega, 0.5);
}

TEST(Api, WritePlanRefusesInvalidPlans) {
  const Instance instance = small();
  Solution solution = solve(instance, {.omega = 0.5});
  TemporaryDirectory directory;
  solution.plan->agents[0].path.front() = solution.plan->agents[0].path.back();
  EXPECT_EQ(field_of([&] { write_plan(directory / "p.json", instance, solution); }),
            "/agents/0/path/0");
  EXPECT_EQ(field_of([&] { plan_text(instance, solution); }), "/agents/0/path/0");
  EXPECT_FALSE(std::filesystem::exists(directory / "p.json"));
}

// A bound proven for plans without following does not hold for plans with following.
TEST(Api, ClaimsWithoutFollowingKeepThatRule) {
  const Instance instance = small();
  const Instance strict(instance.world(), instance.agents(), instance.tasks(),
                        {.following = false});
  const std::string text = plan_text(strict, solve(strict));
  const Solution read = parse_plan(text, instance);
  EXPECT_FALSE(read.following);
  EXPECT_THAT(plan_text(instance, read), ::testing::HasSubstr("\"following\": false"));
  EXPECT_TRUE(parse_plan(plan_text(instance, solve(instance)), instance).following);
}

TEST(Api, InvalidArgumentNamesTheField) {
  const World world = World::from_rows(kRows);
  const auto with = [&](Agent agent) {
    return field_of([&] { Instance(world, {std::move(agent)}, {}); });
  };
  EXPECT_EQ(with({.id = "", .start = {Cell{0, 0}}}), "/agents/0/id");
  EXPECT_EQ(with({.id = "a", .start = {Cell{1, 1}}}), "/agents/0/start");
  EXPECT_EQ(with({.id = "a", .start = {Cell{-1, 1}}}), "/agents/0/start");
  EXPECT_EQ(with({.id = "a", .start = {Vertex{"A"}}}), "/agents/0/start");
  EXPECT_EQ(with({.id = "a", .start = {Cell{0, 0}, Heading::east}}), "/agents/0/start");
  EXPECT_EQ(with({.id = "a", .start = {Cell{0, 0}}, .turn_steps = 1}), "/agents/0/start");
  EXPECT_EQ(with({.id = "a", .start = {Cell{0, 0}}, .goal = Cell{3, 1}}), "/agents/0/goal");
  EXPECT_EQ(field_of([&] {
              Instance(world, {{.id = "a", .start = {Cell{0, 0}}}},
                       {{.id = "t", .place = Cell{0, 0}, .agents = {"a", "b"}}});
            }),
            "/tasks/0/agents/1");
  EXPECT_EQ(field_of([&] {
              Instance(world, {{.id = "a", .start = {Cell{0, 0}}}},
                       {{.id = "t", .place = Cell{1, 1}, .agents = {"a"}}});
            }),
            "/tasks/0/place");
  EXPECT_EQ(field_of([] { World::from_rows({"..", "."}); }), "/1");
  EXPECT_EQ(field_of([] { World::from_rows({"..", ".x"}); }), "/1");
  EXPECT_EQ(field_of([] { World::from_rows({}); }), "");
  EXPECT_EQ(field_of([] {
              World::roadmap({{"A", 0, 0}}, {{.from = "A", .to = "B"}});
            }),
            "/edges/0/to");
  EXPECT_EQ(field_of([] {
              World::roadmap({{"A", 0, 0}}, {{.from = "A", .to = "A", .steps = 3}});
            }),
            "/edges/0");
  const auto field_of_options = [](Options options) {
    return field_of([&] { solve(small(), options); });
  };
  EXPECT_EQ(field_of_options({.omega = -1}), "/omega");
  EXPECT_EQ(field_of_options({.omega = std::numeric_limits<double>::quiet_NaN()}), "/omega");
  EXPECT_EQ(field_of_options({.time_limit = -1}), "/time_limit");
  EXPECT_EQ(field_of_options({.threads = 0}), "/threads");
  EXPECT_EQ(field_of_options({.method = "magic"}), "/method");
  EXPECT_EQ(field_of_options({.method = "cts-cbs-a"}), "/method");
  EXPECT_EQ(field_of_options({.start = Plan{}}), "/agents");
  EXPECT_THROW(read_instance("none.cts.json"), InputError);
  EXPECT_THROW(parse_instance("{"), InputError);
  EXPECT_THROW(World::read("none.map"), InputError);
  EXPECT_THROW(parse_plan("[]", small()), InputError);
}

TEST(Api, TextsWithUnknownKeysAreRefused) {
  const auto message = [](const std::function<void()>& act) -> std::string {
    try {
      act();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const World world = World::from_rows({"...."});
  const std::string agent = R"({"id": "a", "start": [0, 0], "gaol": [3, 0]})";
  EXPECT_EQ(
      message([&] { parse_instance(R"({"agents": [)" + agent + R"(], "tasks": []})", world); }),
      "the instance: /agents/0: unknown key 'gaol'; expected 'goal', if that is meant");
  std::string plan = plan_text(small(), solve(small()));
  EXPECT_EQ(message([&] { parse_plan(plan, small()); }), "accepted");
  plan.insert(1, R"("priority": 1, )");
  EXPECT_EQ(
      message([&] { parse_plan(plan, small()); }),
      "the plan: /: unknown key 'priority'; Grove does not model priorities; expected no such "
      "key");
}

TEST(Api, DefaultsHaveLimitsAndUseAllCores) {
  const Options options;
  EXPECT_EQ(options.omega, 0.01);
  EXPECT_EQ(options.time_limit, 180);
  EXPECT_EQ(options.threads, default_threads());
  EXPECT_GE(options.threads, 1);
  EXPECT_EQ(options.memory_limit, default_memory_limit());
  EXPECT_GT(*options.memory_limit, 0U);
  EXPECT_EQ(Session::default_options().time_limit, 1);
  EXPECT_EQ(Session::default_options().omega, options.omega);
}

TEST(Api, CallsBackOnIncumbentsAndProgress) {
  for (const double interval : {0.0, 1e9}) {
    std::stop_source stop;
    std::vector<std::int64_t> costs;
    int progress_calls = 0;
    Options options{.omega = 0, .stop = stop.get_token(), .progress_interval = interval};
    options.on_incumbent = [&](const Plan& plan, const Progress& progress) {
      costs.push_back(plan.cost);
      EXPECT_LE(progress.lower_bound, plan.cost);
      EXPECT_EQ(progress.cost, plan.cost);
      if (costs.size() == 3) stop.request_stop();
    };
    options.on_progress = [&](const Progress&) { ++progress_calls; };
    const Solution solution = solve(dense_instance(), options);
    ASSERT_GE(costs.size(), 3u);
    EXPECT_EQ(costs.back(), solution.plan->cost);
    EXPECT_TRUE(std::ranges::is_sorted(costs, std::greater<>()));
    if (interval > 0)
      EXPECT_EQ(progress_calls, 2) << "at the beginning and at the end";
    else
      EXPECT_GT(progress_calls, 3);
  }
}

TEST(Api, ExceptionOfACallbackEndsTheRunAndPropagates) {
  struct Mine {};
  Options options{.omega = 0, .time_limit = 60};
  options.on_incumbent = [](const Plan&, const Progress&) { throw Mine(); };
  EXPECT_THROW(solve(dense_instance(), options), Mine);
}

TEST(Api, StopsOnRequest) {
  std::stop_source stop;
  Options options{.omega = 0, .time_limit = 120, .stop = stop.get_token(), .threads = 2};
  std::promise<void> has_plan;
  options.on_incumbent = [&, first = true](const Plan&, const Progress&) mutable {
    if (std::exchange(first, false)) has_plan.set_value();
  };
  std::jthread later([&] {
    has_plan.get_future().wait();
    stop.request_stop();
  });
  const Solution solution = solve(dense_instance(), options);
  EXPECT_EQ(solution.texts.at("stopped_by"), "interrupt");
  EXPECT_NE(solution.status, Status::infeasible);
}

TEST(Api, SeveralSolvesRunConcurrently) {
  std::atomic<int> optimal = 0;
  const std::int64_t cost = solve(small()).plan->cost;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        for (int k = 0; k < 5; ++k)
          optimal += solve(small(), {.threads = 1 + k % 2}).plan->cost == cost;
      });
  }
  EXPECT_EQ(optimal, 20);
}

TEST(Api, SolveReportsInfeasibility) {
  const Instance instance(World::from_rows({"..@.."}),
                          {{.id = "a", .start = {Cell{0, 0}}, .goal = Cell{4, 0}}}, {});
  const Solution solution = solve(instance);
  EXPECT_EQ(solution.status, Status::infeasible);
  EXPECT_FALSE(solution.plan);
  EXPECT_FALSE(solution.gap());
}

TEST(Api, SessionAdvancesChangesAndReplans) {
  Session session(small());
  EXPECT_FALSE(session.plan());
  EXPECT_EQ(field_of([&] { session.advance(1); }), "");
  ASSERT_EQ(session.replan().status, Status::optimal);
  const Plan before = *session.plan();
  session.advance(2, {{.agent = "red", .steps = 1}});
  EXPECT_EQ(session.instance().agents()[0].start, before.pose(0, 1));
  session.change({.new_tasks = {{.id = "more", .place = Cell{0, 1}, .agents = {"blue"}}},
                  .dropped_tasks = {"look"}});
  const Solution after = session.replan({.omega = 0}, 1);
  ASSERT_TRUE(after.plan);
  EXPECT_THAT(check(session.instance(), *session.plan()), IsEmpty());
  EXPECT_THAT(after.plan->agents[1].tasks, ::testing::Contains("more"));
  EXPECT_EQ(field_of([&] { session.change({.dropped_tasks = {"none"}}); }), "/dropped_tasks/0");
  EXPECT_EQ(field_of([&] {
              session.change({.new_tasks = {{.id = "t", .place = Cell{1, 1}, .agents = {"red"}}}});
            }),
            "/new_tasks/0/place");
  EXPECT_EQ(field_of([&] { session.advance(1, {{.agent = "green", .steps = 1}}); }), "/late/0");
  EXPECT_EQ(field_of([&] { session.advance(1, {{.agent = "red", .steps = 2}}); }), "/late");
  Session with(small(), before);
  with.advance(1);
  EXPECT_TRUE(with.plan());
  EXPECT_EQ(field_of([&] { Session(small(), Plan{}); }), "/agents");
}

TEST(Api, VersionMatchesItsMacros) {
  EXPECT_STREQ(version(), GROVE_VERSION);
  EXPECT_EQ(std::string(GROVE_VERSION), std::to_string(GROVE_VERSION_MAJOR) + "." +
                                            std::to_string(GROVE_VERSION_MINOR) + "." +
                                            std::to_string(GROVE_VERSION_PATCH));
}

}  // namespace api_test
}  // namespace grove
