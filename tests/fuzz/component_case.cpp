// SPDX-License-Identifier: MIT
#include "tests/fuzz/component_case.h"

#include <algorithm>
#include <utility>

#include "model/check.h"
#include "tests/fuzz/random.h"
#include "tests/fuzz/random_instance.h"

namespace grove::detail::fuzz {
namespace {

constexpr double kAtOnce = 1e6;  // effort ratio at which all other components wait
constexpr std::int64_t kToTheEnd = 1'000'000'000'000;

std::vector<std::string> open_board(Random& random) {
  std::vector<std::string> rows(static_cast<std::size_t>(random.between(3, 5)));
  const auto width = static_cast<std::size_t>(random.between(4, 5));
  const int blocked = random.pick<int>({0, 0, 10, 20});
  for (std::string& row : rows) {
    row.assign(width, '.');
    for (char& cell : row)
      if (random.percent(blocked)) cell = '@';
  }
  return rows;
}

// Two rooms joined by a corridor, sometimes two cells wide.
std::vector<std::string> corridor_board(Random& random) {
  const auto length = static_cast<std::size_t>(random.between(1, 5));
  const auto room = static_cast<std::size_t>(random.between(1, 2));
  std::vector<std::string> rows(
      3, std::string(room, '.') + std::string(length, '@') + std::string(room, '.'));
  rows[1].assign(rows[1].size(), '.');
  if (random.percent(30)) rows[2].assign(rows[2].size(), '.');
  return rows;
}

// Random starts and goals. Some agents with a goal have one task; agents without a goal have up to
// two.
TinyInstance roomy_instance(std::uint64_t seed) {
  Random random(seed ^ 0x4007);
  TinyInstance instance;
  instance.rows = random.percent(60) ? open_board(random) : corridor_board(random);
  std::vector<Position> starts = passable_cells(instance.rows);
  std::vector<Position> ends = starts;
  random.shuffle(starts);
  random.shuffle(ends);
  const int agents =
      std::min(random.pick<int>({2, 2, 3, 3, 3, 4}), static_cast<int>(starts.size()) - 1);
  int tasks = 0;
  for (int a = 0; a < agents; ++a) {
    instance.agents.push_back({starts[a], ends[a]});
    const bool rests_anywhere = random.percent(20);
    if (rests_anywhere) instance.agents.back().goal.reset();
    for (int more = rests_anywhere ? 2 : random.below(8) / 5; more > 0 && tasks < 4; --more) {
      const Position cell = random.pick(ends);
      const auto is_there = [&](const TinyInstance::Task& task) { return task.cell == cell; };
      if (std::ranges::any_of(instance.tasks, is_there)) continue;
      instance.tasks.push_back({cell, {a}});
      ++tasks;
    }
  }
  return instance;
}

// More agents and tasks in less space, so that choices decide who passes whom.
TinyInstance narrow_instance(std::uint64_t seed) {
  Random random(seed ^ 0xC401);
  TinyInstance instance;
  instance.rows = corridor_board(random);
  std::vector<Position> starts = passable_cells(instance.rows);
  std::vector<Position> ends = starts;
  std::vector<Position> cells = starts;
  random.shuffle(starts);
  random.shuffle(ends);
  random.shuffle(cells);
  const int agents = std::min(random.between(3, 4), static_cast<int>(starts.size()) - 1);
  for (int a = 0; a < agents; ++a) {
    instance.agents.push_back({starts[a], ends[a]});
    if (random.percent(10)) instance.agents.back().goal.reset();
  }
  const int tasks = std::min(random.between(0, 3), static_cast<int>(cells.size()));
  for (int t = 0; t < tasks; ++t) instance.tasks.push_back({cells[t], {random.below(agents)}});
  return instance;
}

Techniques some_of(Techniques techniques, Techniques wanted, Random& random) {
  for (const auto& [technique, name] : kTechniques)
    if (wanted.has(technique) && random.percent(70)) techniques = techniques.with(technique);
  return techniques;
}

Techniques of_tree(Random& random) {
  return some_of({},
                 {Technique::kStrongBranching, Technique::kBypass, Technique::kFewestConflicts,
                  Technique::kTarget, Technique::kCorridor},
                 random);
}

Techniques of_pairs(Random& random) {
  const Techniques always = of_tree(random).with(Technique::kWdg);
  return some_of(always, {Technique::kJointMdd, Technique::kCostSplits, Technique::kClusters},
                 random);
}

void choose_techniques(Part part, SolveOptions& options, Random& random) {
  Tuning& tuning = options.tuning;
  switch (part) {
    case Part::kAny:
      return;
    case Part::kTree:
      options.techniques = of_tree(random);
      return;
    case Part::kPairs:
      options.techniques = of_pairs(random);
      tuning.pair_expansions = random.pick<std::int64_t>({1, 2, 16});
      tuning.joint_mdd_nodes = random.pick<std::int64_t>({1, 50'000, 50'000});
      tuning.mdd_nodes = random.pick<std::int64_t>({10, 20'000, 20'000});
      return;
    case Part::kGroups:
      options.techniques =
          of_pairs(random).with(Technique::kJointGroups).with(Technique::kClusters);
      tuning.pair_expansions = tuning.group_expansions = 1;
      return;
    case Part::kJoint:
      options.techniques = {Technique::kJointSearch};
      tuning.joint_start_work = 0;
      tuning.joint_step_work = kToTheEnd;
      tuning.joint_max_share = kAtOnce;
      return;
    case Part::kPrices:
      options.techniques = {Technique::kLagrangian};
      tuning.lagrangian_min_agents = 1;
      tuning.lagrangian_start_work = 0;
      tuning.lagrangian_max_share = kAtOnce;
      tuning.lagrangian_level = 0.3;
      return;
    case Part::kCores:
      options.techniques = of_tree(random).with(Technique::kCores);
      tuning.cores_start_work = 0;
      tuning.cores_share = tuning.cores_share_with_tasks = tuning.cores_max_share = kAtOnce;
      return;
    case Part::kSequences:
      options.policy = Policy::kFixed;
      options.rtsp = random.pick<RtspBackend>(
          {RtspBackend::kAuto, RtspBackend::kHeldKarp, RtspBackend::kBoundedDp});
      return;
    case Part::kChoices:
      return;
  }
}

}  // namespace

FuzzCase component_case(Part part, std::uint64_t seed) {
  FuzzCase fuzz_case = random_case(seed);
  if (part == Part::kAny) return fuzz_case;
  if (seed % 2 == 0)
    fuzz_case.instance = part == Part::kChoices ? narrow_instance(seed) : roomy_instance(seed);
  fuzz_case.limit = ImposedLimit::kNothing;
  SolveOptions options;
  options.omega = Omega::from_double(0);
  options.policy = Policy::kFree;
  options.seed = seed;
  Random random(seed ^ 0x10E);
  choose_techniques(part, options, random);
  fuzz_case.options = options;
  return part == Part::kChoices ? with_choices(std::move(fuzz_case), seed + 1) : fuzz_case;
}

Plan higher_cost_plan(const Instance& instance, const Plan& plan) {
  for (std::size_t agent = 0; agent < plan.agents.size(); ++agent)
    for (Time time = 0; time < plan.agents[agent].cost; ++time) {
      Solution slower;
      slower.plan = plan;
      ++slower.plan->cost;
      AgentPlan& waits = slower.plan->agents[agent];
      ++waits.cost;
      waits.path.insert(waits.path.begin() + time, waits.path[static_cast<std::size_t>(time)]);
      for (WorkTime& work : waits.work) {
        if (work.begin < time) continue;
        ++work.begin;
        ++work.end;
      }
      slower.status = status_of(slower.plan->cost, 0, slower.omega);
      slower.may_follow = instance.may_follow();
      if (check(instance, slower, 1).empty()) return *slower.plan;
    }
  return plan;
}

}  // namespace grove::detail::fuzz
