// SPDX-License-Identifier: MIT
// Compares solution methods with the oracle on tiny instances. Exact methods must find the optimum;
// adaptations must not claim more than they prove. GROVE_FUZZ_FACTOR multiplies the number of
// instances.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "engine/destinations.h"
#include "engine/method.h"
#include "engine/run_observer.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"
#include "tests/support/random_choices.h"

namespace grove::detail::fuzz {
namespace methods_test {

// Returns a random instance in which every agent with a task can end on any of its tasks.
Instance mg_instance(std::uint64_t seed) {
  TinyInstance tiny = random_instance(seed);
  for (std::size_t agent = 0; agent < tiny.agents.size(); ++agent)
    if (std::ranges::any_of(tiny.tasks, [&](const TinyInstance::Task& task) {
          return std::ranges::count(task.agents, static_cast<int>(agent)) > 0;
        }))
      tiny.agents[agent].goal = std::nullopt;
  return tiny.build();
}

bool has_free_end(const Instance& instance) {
  return std::ranges::any_of(instance.agents(), [](const Agent& agent) { return !agent.goal; });
}

struct Ended {
  Solution solution;
  bool stopped = false;
};

Ended run(Method method, const Instance& instance, SolveOptions options, bool anytime = false,
          RunObserver* observer = nullptr) {
  options = options_of(method, options);
  const testing::ClockReadingLimit limits(100'000);
  Ended ended{solve_by(method, anytime, instance, options, limits, observer)};
  ended.stopped = ended.solution.stats.texts.count("stopped_by") > 0;
  return ended;
}

class ExactMethods : public ::testing::TestWithParam<Method> {};

TEST_P(ExactMethods, FindTheOptimumOfMgInstances) {
  int solvable = 0;
  int ended = 0;
  const std::uint64_t seeds = testing::fuzz_rounds(80);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = mg_instance(seed);
    const oracle::Answer truth = oracle::solve_jointly(instance);
    if (!truth.plan || !has_free_end(instance)) continue;
    ++solvable;
    const auto [solution, stopped] = run(GetParam(), instance, {});
    EXPECT_EQ(false_claims(instance, truth, {}, solution, stopped), std::vector<std::string>());
    if (stopped) continue;
    ++ended;
    EXPECT_EQ(solution.status, Status::kOptimal);
  }
  EXPECT_GT(solvable, 25);
  EXPECT_GT(ended, solvable * 9 / 10);
  RecordProperty("solvable", solvable);
  RecordProperty("ended", ended);
}

INSTANTIATE_TEST_SUITE_P(, ExactMethods,
                         ::testing::Values(Method::kAuto, Method::kOptimalCbs, Method::kHcbs,
                                           Method::kMgcbs, Method::kCtsCbsA),
                         [](const auto& all) {
                           std::string name(name_of(all.param));
                           std::erase(name, '-');
                           return name;
                         });

// A random instance with choices that the method accepts; nullopt: this seed has none.
std::optional<Instance> instance_for(Method method, std::uint64_t seed) {
  TinyInstance tiny = random_instance(seed);
  if (method == Method::kCbsTa) tiny.tasks.clear();
  try {
    Instance instance = with_random_choices(tiny.build(), seed);
    require_fit(method, instance, options_of(method, {}));
    if (instance.has_choices()) return instance;
  } catch (const std::invalid_argument&) {  // a refusal
  }
  return std::nullopt;
}

class AssignmentMethods : public ::testing::TestWithParam<Method> {};

TEST_P(AssignmentMethods, FindTheOptimumOfInstancesWithChoices) {
  if (GetParam() == Method::kCbsTs && !is_built(RtspBackend::kCbc))
    GTEST_SKIP() << "Grove was built without CBC";
  int solvable = 0;
  int ended = 0;
  const std::uint64_t seeds = testing::fuzz_rounds(150);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto instance = instance_for(GetParam(), seed);
    if (!instance) continue;
    const oracle::Answer truth = oracle::solve_jointly(*instance);
    if (!truth.plan) continue;
    ++solvable;
    const auto [solution, stopped] = run(GetParam(), *instance, {});
    EXPECT_EQ(false_claims(*instance, truth, {}, solution, stopped), std::vector<std::string>());
    if (stopped) continue;
    ++ended;
    EXPECT_EQ(solution.status, Status::kOptimal);
  }
  EXPECT_GT(solvable, 10);
  EXPECT_GT(ended, solvable * 8 / 10);
}

INSTANTIATE_TEST_SUITE_P(, AssignmentMethods, ::testing::Values(Method::kCbsTa, Method::kCbsTs),
                         [](const auto& all) {
                           std::string name(name_of(all.param));
                           std::erase(name, '-');
                           return name;
                         });

TEST(MethodsForAssignments, RefuseWhatTheyDoNotSupport) {
  SolveOptions free;
  free.policy = Policy::kFree;
  EXPECT_THROW(options_of(Method::kCbsTa, free), std::invalid_argument);
  const Instance with_task = testing::instance_of({"..."}, {{{0, 0}, Position{2, 0}, {{1, 0}}}});
  EXPECT_THROW(require_fit(Method::kCbsTa, with_task, options_of(Method::kCbsTa, {})),
               std::invalid_argument);
}

// Returns the least cost of one agent with destination `goal` and without the task `end`, ignoring
// all other agents; kInfiniteCost if the oracle finds no plan.
Cost single_agent_cost(const Instance& instance, AgentIndex agent, std::optional<Cell> goal,
                       TaskIndex end) {
  const Grid& grid = instance.grid();
  InstanceBuilder builder(grid);
  const Agent& a = instance.agent(agent);
  builder.add_agent(a.id, grid.position(a.start),
                    goal ? std::optional(grid.position(*goal)) : std::nullopt);
  const std::string ids[] = {a.id};
  for (TaskIndex task : a.tasks)
    if (task != end)
      builder.add_task(instance.task(task).id, grid.position(instance.task(task).cell), ids);
  const auto answer = oracle::solve_jointly(std::move(builder).build());
  return answer.plan ? answer.plan->cost : kInfiniteCost;
}

// Returns the minimum, over all choices of distinct destinations not in `taken` for `agent` and all
// later agents, of their costs plus Tuning::visitor_steps for every other visitor of a chosen
// destination.
Cost best_choice(const Instance& instance, AgentIndex agent, std::vector<Cell>& taken) {
  if (agent == instance.agent_count()) return 0;
  if (const auto goal = instance.agent(agent).goal)
    return single_agent_cost(instance, agent, goal, kNoTask) +
           best_choice(instance, agent + 1, taken);
  Cost best = kInfiniteCost;
  for (TaskIndex task : instance.agent(agent).tasks) {
    const Cell cell = instance.task(task).cell;
    if (std::ranges::count(taken, cell) > 0) continue;
    taken.push_back(cell);
    const Cost visitors = std::ssize(instance.task(task).agents) - 1;
    best = std::min(best, single_agent_cost(instance, agent, cell, task) +
                              Tuning().visitor_steps * visitors +
                              best_choice(instance, agent + 1, taken));
    taken.pop_back();
  }
  return best;
}

TEST(Destinations, AreDistinctAndCheapest) {
  int chosen = 0;
  int raised = 0;  // instances in which distinct destinations cost more
  const std::uint64_t seeds = testing::fuzz_rounds(80);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = mg_instance(seed);
    const Problem problem(instance, Limits());
    RunObserver silent;
    if (!has_free_end(instance) || presolve(problem, {}, Limits(), silent)) continue;
    const auto destinations = choose_destinations(problem, Tuning().visitor_steps, Limits());
    ASSERT_TRUE(destinations);
    ++chosen;
    Cost bound = 0;
    Cost cost = 0;
    std::vector<Cell> taken;
    const Instance with = with_destinations(instance, *destinations);
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
      bound += single_agent_cost(instance, agent, instance.agent(agent).goal, kNoTask);
      cost += single_agent_cost(with, agent, with.agent(agent).goal, kNoTask);
      if (const TaskIndex end = destinations->tasks[agent]; end != kNoTask)
        cost += Tuning().visitor_steps * (std::ssize(instance.task(end).agents) - 1);
      if (const auto goal = instance.agent(agent).goal) taken.push_back(*goal);
    }
    EXPECT_EQ(destinations->bound, bound);
    EXPECT_EQ(cost, best_choice(instance, 0, taken));
    if (cost > bound) ++raised;
  }
  EXPECT_GT(chosen, 30);
  EXPECT_GT(raised, 1);
}

// Checks every reported plan and bound against the oracle.
class CheckedEvents : public RunObserver {
 public:
  CheckedEvents(const Instance& instance, const oracle::Answer& truth)
      : instance_(instance), truth_(truth) {}

  void on_incumbent(const Plan& plan, PlanSource, const Progress& progress) override {
    Solution solution;
    solution.plan = plan;
    solution.status = status_of(plan.cost, 0, Omega::infinite());
    solution.omega = Omega::infinite();
    EXPECT_EQ(false_claims(instance_, truth_, Omega::infinite(), solution, true),
              std::vector<std::string>());
    EXPECT_LE(progress.lower_bound, truth_.plan->cost);
    EXPECT_GE(progress.lower_bound, bound_);
    EXPECT_EQ(progress.incumbent, plan.cost);
    EXPECT_LT(plan.cost, best_);
    best_ = plan.cost;
  }
  void on_infeasible(std::string_view reason) override { ADD_FAILURE() << reason; }
  void on_event(RunEvent event, const Progress& progress) override {
    EXPECT_FALSE(ended_);
    ended_ = event == RunEvent::kEnd;
    EXPECT_LE(progress.lower_bound, truth_.plan->cost);
    EXPECT_GE(progress.lower_bound, bound_);
    EXPECT_GE(progress.nodes_expanded, nodes_);
    bound_ = progress.lower_bound;
    nodes_ = progress.nodes_expanded;
    if (event == RunEvent::kIncumbent) {
      EXPECT_EQ(progress.incumbent, best_);
    }
  }
  bool ended() const { return ended_; }
  // Returns whether the solution has the cost of the last reported plan and at least the last
  // reported bound.
  bool is_result(const Solution& solution) const {
    return solution.lower_bound >= bound_ &&
           (solution.plan ? solution.plan->cost : kInfiniteCost) == best_;
  }

 private:
  const Instance& instance_;
  const oracle::Answer& truth_;
  Cost best_ = kInfiniteCost;
  Cost bound_ = 0;
  std::int64_t nodes_ = 0;
  bool ended_ = false;
};

struct Adaptation {
  const char* name;
  Method method;
  bool anytime;
};

class Adaptations : public ::testing::TestWithParam<Adaptation> {};

// With the destinations that method B chooses, every plan costs at least 6: a1 must visit the
// shared task before a0 rests on it, or must rest on it itself. The optimum is 4.
Instance worse_with_destinations() {
  return testing::instance_of({"...."}, {{{0, 0}, std::nullopt, {{0, 0}, {1, 0}}},
                                         {{3, 0}, std::nullopt, {{1, 0}, {3, 0}}}});
}

TEST_P(Adaptations, ReportNoBoundOfChosenDestinations) {
  const Instance instance = worse_with_destinations();
  const oracle::Answer truth = oracle::solve_jointly(instance);
  ASSERT_EQ(truth.plan->cost, 4);
  CheckedEvents events(instance, truth);
  const auto [solution, stopped] =
      run(GetParam().method, instance, {}, GetParam().anytime, &events);
  EXPECT_EQ(solution.status,
            GetParam().method == Method::kCtsCbsB ? Status::kFeasible : Status::kOptimal);
}

TEST_P(Adaptations, ClaimNoMoreThanTheyProve) {
  int plans = 0;
  int feasible = 0;
  const std::uint64_t seeds = testing::fuzz_rounds(60);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = mg_instance(seed);
    if (!has_free_end(instance)) continue;
    const oracle::Answer truth = oracle::solve_jointly(instance);
    if (!truth.plan) continue;
    SolveOptions options;
    options.omega = Omega::parse(seed % 3 == 0 ? "0" : seed % 3 == 1 ? "0.1" : "inf");
    options.policy = seed % 2 == 0 ? Policy::kFixed : Policy::kFree;
    CheckedEvents events(instance, truth);
    const auto [solution, stopped] =
        run(GetParam().method, instance, options, GetParam().anytime, &events);
    EXPECT_EQ(false_claims(instance, truth, options.omega, solution, true),
              std::vector<std::string>());
    EXPECT_TRUE(events.ended() || !solution.plan);
    EXPECT_TRUE(events.is_result(solution));
    if (solution.status == Status::kOptimal || solution.status == Status::kBounded) {
      EXPECT_EQ(solution.stats.texts.count("remark"), 0u);
    }
    plans += solution.plan ? 1 : 0;
    feasible += solution.status == Status::kFeasible ? 1 : 0;
    if (!solution.plan && !stopped) {
      EXPECT_GT(solution.stats.texts.count("reason") + solution.stats.texts.count("remark"), 0u);
    }
  }
  EXPECT_GT(plans, 20);
  EXPECT_GT(feasible, 0);
}

INSTANTIATE_TEST_SUITE_P(, Adaptations,
                         ::testing::Values(Adaptation{"B", Method::kCtsCbsB, false},
                                           Adaptation{"C", Method::kCtsCbsC, false},
                                           Adaptation{"Anytime", Method::kCtsCbsC, true}),
                         [](const auto& all) { return std::string(all.param.name); });

// The agents cannot change places on a line. Agent 1 must end on its only task, and no task of
// agent 0 lies beyond it, so there is no plan. No constraint-tree search proves this, so method A
// runs until the time limit. Method B then finds that its chosen destinations allow no plan, which
// proves nothing about other destinations.
TEST(AdaptationC, ReportsStopReasonOfAIfBFindsNoPlan) {
  const Instance instance = testing::instance_of(
      {".@", "..", "@.", ".."},
      {{{1, 2}, std::nullopt, {{1, 1}, {1, 2}, {0, 1}}}, {{0, 1}, std::nullopt, {{1, 2}}}});
  SolveOptions options;
  options.omega = Omega::parse("0");
  options.techniques =
      options.techniques.without(Technique::kJointSearch);  // it would prove infeasibility
  for (const bool anytime : {false, true}) {
    const testing::ClockReadingLimit limits(5'000);
    const Solution solution =
        solve_by(Method::kCtsCbsC, anytime, instance, options, limits, nullptr);
    EXPECT_EQ(solution.status, Status::kUnknown);
    const auto& texts = solution.stats.texts;
    ASSERT_EQ(texts.count("stopped_by"), 1u);
    EXPECT_EQ(texts.at("stopped_by"), "time limit");
    EXPECT_EQ(texts.count("reason"), 0u);
  }
}

// The plan of method B is optimal for the destinations that B chooses.
TEST(AdaptationB, IsOptimalForItsDestinations) {
  int compared = 0;
  const std::uint64_t seeds = testing::fuzz_rounds(60);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = mg_instance(seed);
    const Problem problem(instance, Limits());
    RunObserver silent;
    if (!has_free_end(instance) || presolve(problem, {}, Limits(), silent)) continue;
    const auto [solution, stopped] = run(Method::kCtsCbsB, instance, {});
    if (stopped) continue;
    const auto destinations = choose_destinations(problem, Tuning().visitor_steps, Limits());
    const auto truth = oracle::solve_jointly(with_destinations(instance, *destinations));
    ASSERT_EQ(solution.plan.has_value(), truth.plan.has_value());
    if (!truth.plan) continue;
    EXPECT_EQ(solution.plan->cost, truth.plan->cost);
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

// Returns a dense instance that hardly any search solves within a tenth of a second.
Instance dense_instance(unsigned seed) {
  constexpr int kSide = 8;
  constexpr int kAgents = 16;
  std::mt19937 random(seed);
  std::vector<Position> cells;
  for (int x = 0; x < kSide; ++x)
    for (int y = 0; y < kSide; ++y) cells.push_back({x, y});
  std::ranges::shuffle(cells, random);
  std::vector<testing::AgentSpec> agents;
  for (int agent = 0; agent < kAgents; ++agent) agents.push_back({cells[agent], std::nullopt});
  for (int task = 0; task < 2 * kAgents; ++task)
    for (int visitor = 0; visitor < 2; ++visitor)
      agents[(task + visitor * 3) % kAgents].tasks.push_back(cells[kAgents + task]);
  return testing::instance_of(std::vector<std::string>(kSide, std::string(kSide, '.')), agents);
}

// Stores the best plan and bound that the search reports.
class RecordedEvents : public RunObserver {
 public:
  void on_incumbent(const Plan& plan, PlanSource, const Progress& progress) override {
    best_ = std::min(best_, plan.cost);
    record(progress);
  }
  void on_event(RunEvent, const Progress& progress) override { record(progress); }
  void on_note(std::string_view note) override { notes_.emplace_back(note); }

  Cost best() const { return best_; }
  Cost bound() const { return bound_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void record(const Progress& progress) {
    EXPECT_GE(progress.lower_bound, bound_);
    bound_ = progress.lower_bound;
  }

  Cost best_ = kInfiniteCost;
  Cost bound_ = 0;
  std::vector<std::string> notes_;
};

TEST(AdaptationC, ReturnsBestOfBothSearches) {
  int of_both = 0;
  const int seeds = testing::fuzz_rounds(12);
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = dense_instance(static_cast<unsigned>(seed));
    SolveOptions options;
    options.omega = Omega::parse("0");
    options.policy = seed % 4 < 2 ? Policy::kFixed : Policy::kFree;
    const testing::ClockReadingLimit limits(1'000 + 300 * (seed % 4));
    RecordedEvents events;
    const Solution solution =
        solve_by(Method::kCtsCbsC, seed % 2 == 0, instance, options, limits, &events);
    EXPECT_EQ(solution.lower_bound, events.bound());
    EXPECT_EQ(solution.plan ? solution.plan->cost : kInfiniteCost, events.best());
    of_both += events.notes().size() == 2 ? 1 : 0;
  }
  EXPECT_GT(of_both, seeds * 3 / 4);
}

TEST(AdaptationC, RunsOneSearchIfItProvesOptimality) {
  const Instance instance = testing::instance_of({"...."}, {{{0, 0}, std::nullopt, {{3, 0}}}});
  for (const bool anytime : {false, true}) {
    RecordedEvents events;
    const Solution solution = solve_by(Method::kCtsCbsC, anytime, instance, {}, Limits(), &events);
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_EQ(events.notes().size(), 1u);
  }
}

TEST(Method, SelectsItsLowLevel) {
  EXPECT_EQ(options_of(Method::kOptimalCbs, {}).low_level, LowLevel::kVisitedSets);
  EXPECT_EQ(options_of(Method::kHcbs, {}).low_level, LowLevel::kSingleLegs);
  EXPECT_EQ(options_of(Method::kMgcbs, {}).low_level, LowLevel::kTimeIntervalForest);
  for (Method method :
       {Method::kAuto, Method::kCtsCbsA, Method::kCtsCbsB, Method::kCtsCbsC, Method::kSCbs})
    EXPECT_EQ(options_of(method, {}).low_level, LowLevel::kOwn);
}

TEST(Method, NamesRoundTrip) {
  for (Method method : all_methods()) EXPECT_EQ(parse_method(name_of(method)), method);
  EXPECT_EQ(parse_method("cbs"), std::nullopt);
}

TEST(Method, RefusesUnsupportedOptions) {
  SolveOptions fixed;
  fixed.policy = Policy::kFixed;
  EXPECT_THROW(options_of(Method::kHcbs, fixed), std::invalid_argument);
  SolveOptions free;
  free.policy = Policy::kFree;
  EXPECT_THROW(options_of(Method::kSCbs, free), std::invalid_argument);
  SolveOptions kept;
  kept.checkpoints.directory = "somewhere";
  EXPECT_THROW(options_of(Method::kMgcbs, kept), std::invalid_argument);
  EXPECT_THROW(options_of(Method::kCtsCbsB, kept), std::invalid_argument);
  EXPECT_NO_THROW(options_of(Method::kSCbs, kept));
  EXPECT_TRUE(options_of(Method::kSCbs, {}).omega.is_infinite());
}

TEST(Method, RefusesUnsupportedInstances) {
  const Instance all_end =
      TinyInstance::parse("map\n...\nagents\n0,0 -> 2,0\ntasks\n1,0: 0\n").build();
  for (Method method : {Method::kCtsCbsA, Method::kCtsCbsB, Method::kCtsCbsC})
    EXPECT_THROW(require_fit(method, all_end, {}), std::invalid_argument);
  EXPECT_NO_THROW(require_fit(Method::kMgcbs, all_end, {}));
}

}  // namespace methods_test
}  // namespace grove::detail::fuzz
