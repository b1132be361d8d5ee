// SPDX-License-Identifier: MIT
// grove-fuzz-metamorphic: metamorphic tests of the search. Most need no oracle, so the instances
// have up to a dozen agents, on maps with difficult shapes.
//
// *Property.* Let P be a valid plan of an instance, of any cost. The bound of a node whose
// constraints P satisfies never exceeds the cost of P. If such a node is expanded with a cutoff
// above the cost of P, then P satisfies the constraints of a child, or the expansion yields a plan
// that costs at most as much as P.
//
// `--mode descend` follows many valid plans down the trees. The cutoffs rise and fall, and all
// descents share one expander and its cache. `--mode agree` compares runs with different options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>

#include "engine/solve.h"
#include "model/check.h"
#include "search/expander.h"
#include "search/feasibility.h"
#include "search/single_tree.h"
#include "tests/fuzz/planted_optimum.h"
#include "tests/fuzz/random.h"
#include "tests/fuzz/random_instance.h"
#include "tests/fuzz/tiny_instance.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {
namespace {

using Rows = std::vector<std::string>;

Rows filled(int width, int height, char c) {
  return Rows(static_cast<std::size_t>(height), std::string(static_cast<std::size_t>(width), c));
}

Rows maze(int w, int h, int loops, Random& random) {
  Rows rows = filled(2 * w - 1, 2 * h - 1, '@');
  std::vector<Position> stack{{0, 0}};
  std::set<std::pair<int, int>> seen{{0, 0}};
  rows[0][0] = '.';
  const int dx[] = {1, -1, 0, 0}, dy[] = {0, 0, 1, -1};
  while (!stack.empty()) {
    const Position p = stack.back();
    std::vector<int> ways;
    for (int d = 0; d < 4; ++d) {
      const int x = p.x + dx[d], y = p.y + dy[d];
      if (x >= 0 && x < w && y >= 0 && y < h && !seen.contains({x, y})) ways.push_back(d);
    }
    if (ways.empty() || random.percent(5)) {
      stack.pop_back();
      continue;
    }
    const int d = random.pick(ways);
    const Position q{p.x + dx[d], p.y + dy[d]};
    seen.insert({q.x, q.y});
    rows[2 * q.y][2 * q.x] = '.';
    rows[p.y + q.y][p.x + q.x] = '.';
    stack.push_back(q);
  }
  for (int i = 0; i < loops; ++i) {
    const int x = random.below(2 * w - 1), y = random.below(2 * h - 1);
    if ((x + y) % 2 == 1) {
      const int x2 = x % 2, y2 = y % 2;
      const bool both = rows[y - y2][x - x2] == '.' && rows[y + y2][x + x2] == '.';
      if (both) rows[y][x] = '.';
    }
  }
  return rows;
}

Rows rooms(int nx, int ny, int size, Random& random) {
  const int w = nx * (size + 1) - 1, h = ny * (size + 1) - 1;
  Rows rows = filled(w, h, '.');
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      if (x % (size + 1) == size || y % (size + 1) == size) rows[y][x] = '@';
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      if (i + 1 < nx && random.percent(85))
        rows[j * (size + 1) + random.below(size)][i * (size + 1) + size] = '.';
      if (j + 1 < ny && random.percent(85))
        rows[j * (size + 1) + size][i * (size + 1) + random.below(size)] = '.';
    }
  return rows;
}

Rows obstacles(int w, int h, int percent, Random& random) {
  Rows rows = filled(w, h, '.');
  for (auto& row : rows)
    for (char& c : row)
      if (random.percent(percent)) c = '@';
  return rows;
}

// A corridor with bays, dead ends, and loops that are joined to it by one cell or by two.
Rows lollipops(int length, Random& random) {
  Rows rows = filled(length, 7, '@');
  for (int x = 0; x < length; ++x) rows[3][x] = '.';
  if (random.percent(60))
    for (int x = 1; x + 1 < length; ++x)
      if (random.percent(50)) rows[4][x] = '.';
  for (int x = 1; x + 2 < length; x += 3) {
    const int kind = random.below(4);
    if (kind == 0) continue;
    rows[2][x] = '.';
    if (kind == 1) continue;
    rows[1][x] = '.';
    if (kind == 2) continue;
    rows[0][x] = rows[0][x + 1] = rows[1][x + 1] = '.';
    if (random.percent(50)) rows[2][x + 1] = '.';
  }
  return rows;
}

std::vector<Position> largest_component(Rows& rows) {
  std::vector<Position> best;
  std::set<std::pair<int, int>> seen;
  for (int y = 0; y < std::ssize(rows); ++y)
    for (int x = 0; x < std::ssize(rows[y]); ++x) {
      if (rows[y][x] != '.' || !seen.insert({x, y}).second) continue;
      std::vector<Position> cells{{x, y}};
      for (std::size_t head = 0; head < cells.size(); ++head) {
        const Position p = cells[head];
        const int dx[] = {1, -1, 0, 0}, dy[] = {0, 0, 1, -1};
        for (int d = 0; d < 4; ++d) {
          const int cx = p.x + dx[d], cy = p.y + dy[d];
          if (cy < 0 || cy >= std::ssize(rows) || cx < 0 || cx >= std::ssize(rows[cy])) continue;
          if (rows[cy][cx] == '.' && seen.insert({cx, cy}).second) cells.push_back({cx, cy});
        }
      }
      if (cells.size() > best.size()) best = cells;
    }
  return best;
}

TinyInstance make(std::uint64_t seed, bool tiny) {
  Random random(seed * 7919 + 13);
  TinyInstance instance;
  std::vector<Position> cells;
  do {
    if (tiny) {
      switch (random.below(5)) {
        case 0:
          instance.rows = maze(random.between(2, 3), random.between(2, 3), random.below(4), random);
          break;
        case 1:
          instance.rows = rooms(2, 1, 2, random);
          break;
        case 2:
          instance.rows = obstacles(random.between(3, 5), random.between(3, 4), 30, random);
          break;
        case 3:
          instance.rows = lollipops(random.between(4, 7), random);
          break;
        default:
          instance.rows =
              rooms(random.between(2, 3), random.between(1, 2), random.between(1, 2), random);
          break;
      }
    } else {
      switch (random.below(5)) {
        case 0:
          instance.rows =
              maze(random.between(4, 6), random.between(4, 6), random.between(2, 20), random);
          break;
        case 1:
          instance.rows =
              rooms(random.between(2, 3), random.between(2, 3), random.between(2, 3), random);
          break;
        case 2:
          instance.rows = obstacles(random.between(7, 12), random.between(7, 12),
                                    random.between(10, 35), random);
          break;
        case 3:
          instance.rows = lollipops(random.between(8, 16), random);
          break;
        default:
          instance.rows =
              obstacles(random.between(4, 6), random.between(4, 6), random.between(0, 15), random);
          break;
      }
    }
    cells = largest_component(instance.rows);
  } while (cells.size() < 5 || (tiny && cells.size() > 18));
  int agents = tiny ? random.between(2, cells.size() > 13 ? 3 : 4)
                    : random.between(3, std::min<int>(11, 3 + static_cast<int>(cells.size()) / 7));
  agents = std::min<int>(agents, static_cast<int>(cells.size()) - 2);
  std::vector<Position> starts = cells, goals = cells;
  random.shuffle(starts);
  random.shuffle(goals);
  const int mg_percent = std::vector<int>{0, 0, 50, 100}[random.below(4)];
  const int home_percent = random.percent(20) ? 50 : 5;
  std::set<std::pair<int, int>> used;
  for (int a = 0; a < agents; ++a) {
    instance.agents.push_back({starts[a], goals[a]});
    (void)home_percent;
  }
  std::map<std::pair<int, int>, std::vector<int>> tasks;
  const int most = random.percent(15) ? 0 : tiny ? random.between(1, 2) : random.between(1, 4);
  for (int a = 0; a < agents; ++a) {
    const bool mg = random.percent(mg_percent);
    if (mg) instance.agents[a].goal.reset();
    int count = most == 0 ? 0 : random.between(0, most);
    if (mg && count == 0) count = 1;
    for (int k = 0; k < count; ++k) {
      Position p = random.pick(cells);
      const int dice = random.below(100);
      const auto& other = instance.agents[random.below(agents)];
      if (dice < 20 && other.goal)
        p = *other.goal;
      else if (dice < 35)
        p = other.start;
      else if (dice < 50 && !tasks.empty()) {
        auto it = tasks.begin();
        std::advance(it, random.below(static_cast<int>(tasks.size())));
        p = {it->first.first, it->first.second};
      }
      auto& who = tasks[{p.x, p.y}];
      if (std::ranges::count(who, a) == 0) who.push_back(a);
    }
  }
  for (auto& [cell, who] : tasks) {
    TinyInstance::Task task;
    task.cell = {cell.first, cell.second};
    task.agents = who;
    instance.tasks.push_back(task);
  }
  return instance;
}

// Returns an instance on a grid or in any other kind of world (roads, turning agents, tasks with a
// duration).
TinyInstance draw(std::uint64_t seed, bool tiny, Random& random) {
  if (tiny && random.percent(30)) return random_instance(seed);
  if (tiny && random.percent(50)) return random_world(seed);
  const TinyInstance instance = make(seed, tiny);
  return tiny || random.percent(50) ? instance : with_motions(instance, seed);
}

Techniques random_techniques(Random& random) {
  if (random.percent(40)) return Techniques::defaults();
  Techniques any = Techniques::defaults();
  for (const auto& [t, name] : kTechniques)
    if (random.percent(35)) any = any.without(t);
  return any;
}

Solution solve_for(const Instance& instance, SolveOptions options, double seconds,
                   RunObserver* observer = nullptr) {
  options.audit = true;
  Limits limits;
  limits.set_deadline(Limits::Clock::now() +
                      std::chrono::microseconds(static_cast<std::int64_t>(seconds * 1e6)));
  return solve(instance, options, limits, observer);
}

std::vector<Path> paths_of(const Instance& instance, const Plan& plan) {
  std::vector<Path> paths;
  for (AgentIndex a = 0; a < instance.agent_count(); ++a)
    paths.push_back(walked_path(instance, a, plan.agents[a]));
  return paths;
}

bool holds(const Instance& instance, const Node& node, const std::vector<Path>& paths) {
  std::vector<std::vector<Constraint>> constraints;
  node.constraints(constraints);
  for (std::size_t a = 0; a < paths.size(); ++a)
    if (!satisfies_all(instance, static_cast<AgentIndex>(a), node.tree().orders[a]->sequences,
                       constraints[a], paths[a]))
      return false;
  return true;
}

bool valid(const Instance& instance, const Plan& plan) {
  Solution claim;
  claim.status = status_of(plan.cost, 0, claim.omega);
  claim.plan = plan;
  return check(instance, claim, 1).empty();
}

struct Counts {
  std::int64_t instances = 0, with_plans = 0, plans = 0, descents = 0, expansions = 0,
               expansions_with_low_cutoff = 0, finished = 0, solves = 0, proven = 0, agreements = 0,
               infeasible = 0, unsolved = 0, histories = 0, histories_differ = 0;
};

// If set, every fourth node of a descent is also expanded by a new expander, and differing results
// are counted.
bool compare_histories = false;

[[noreturn]] void fail(const TinyInstance& tiny, const std::string& what, Techniques techniques,
                       std::uint64_t seed) {
  std::string text =
      fmt::format("# seed {}: {}\n{}options\nomega 0\npolicy free\n", seed, what, tiny.to_text());
  for (const auto& [t, name] : kTechniques)
    if (!techniques.has(t)) text += fmt::format("without {}\n", name);
  throw std::logic_error(text);
}

// Returns valid plans of the instance, at most `wanted`, found on its map and on maps with a few
// more blocked cells. On a roadmap all plans are found on the map itself.
std::vector<Plan> some_plans(const TinyInstance& tiny, const Instance& instance, Random& random,
                             int wanted, double seconds) {
  std::vector<Plan> plans;
  const auto keep = [&](const Solution& s) {
    if (s.plan && valid(instance, *s.plan)) plans.push_back(*s.plan);
  };
  SolveOptions options;
  options.omega = Omega::parse("0");
  keep(solve_for(instance, options, seconds));
  std::vector<Position> free;
  for (int y = 0; y < std::ssize(tiny.rows); ++y)
    for (int x = 0; x < std::ssize(tiny.rows[y]); ++x)
      if (tiny.rows[y][x] == '.' && !in_use(tiny, {x, y})) free.push_back({x, y});
  for (int k = 1; k < wanted; ++k) {
    TinyInstance changed = tiny;
    if (!free.empty() && tiny.roads.empty())
      for (int b = random.below(3); b >= 0; --b) {
        const Position p = random.pick(free);
        changed.rows[p.y][p.x] = '@';
      }
    options.omega = Omega::parse(random.percent(50) ? "inf" : "0.02");
    options.seed = static_cast<std::uint64_t>(random.below(1000));
    options.techniques = random_techniques(random);
    try {
      keep(solve_for(changed.build(), options, seconds / 3));
    } catch (const std::invalid_argument&) {
    }
  }
  return plans;
}

void descend(const TinyInstance& tiny, const Instance& instance, std::uint64_t seed, Random& random,
             double seconds, Counts& counts) {
  const std::vector<Plan> plans = some_plans(tiny, instance, random, 6, seconds);
  counts.plans += std::ssize(plans);
  if (plans.empty()) return;
  ++counts.with_plans;
  const Techniques techniques = random_techniques(random);
  const Limits limits;
  const Problem problem(instance, limits);
  if (const auto reason = presolve_infeasibility(problem)) fail(tiny, *reason, techniques, seed);
  AgentStopsCache stops(instance, problem.distances);
  NodePool pool;
  SingleTree forest(problem, stops, pool, limits);
  const auto expander_seed = static_cast<std::uint64_t>(random.below(100));
  Expander expander(problem, stops, {techniques, expander_seed});
  const NodePtr root = forest.next_root();
  std::vector<NodePtr> reached{root};  // start nodes of descents; not all hold a plan
  const auto end =
      Limits::Clock::now() + std::chrono::milliseconds(static_cast<int>(seconds * 1000));
  for (int round = 0; round < 40 && Limits::Clock::now() < end; ++round) {
    const Plan& plan = random.pick(plans);
    const auto paths = paths_of(instance, plan);
    NodePtr node = random.percent(40) ? root : random.pick(reached);
    if (!holds(instance, *node, paths)) continue;
    ++counts.descents;
    for (int depth = 0; depth < 60 && Limits::Clock::now() < end; ++depth) {
      if (node->bound() > plan.cost)
        fail(tiny,
             fmt::format("a node that holds a plan of {} claims {}", plan.cost, node->bound()),
             techniques, seed);
      const int dice = random.below(100);
      Cost cutoff = dice < 40   ? plan.cost + 1
                    : dice < 60 ? plan.cost + 1 + random.below(6)
                    : dice < 70 ? plan.cost + 1000
                    : dice < 80 ? kInfiniteCost
                    : dice < 90 ? plan.cost
                                : plan.cost - random.below(4);
      Limits short_limits;
      short_limits.set_deadline(end + std::chrono::seconds(2));
      Expansion expansion = expander.expand(node, cutoff, short_limits);
      expander.publish();
      while (expansion.unfinished) {
        expansion = expander.expand(node, cutoff, short_limits);
        expander.publish();
      }
      if (expansion.stopped) {
        if (Limits::Clock::now() < end + std::chrono::seconds(1))
          fail(tiny, "stopped before the limit", techniques, seed);
        return;
      }
      ++counts.expansions;
      if (compare_histories && depth % 4 == 0) {
        AgentStopsCache fresh_stops(instance, problem.distances);
        Expander fresh(problem, fresh_stops, {techniques, expander_seed});
        Expansion other = fresh.expand(node, cutoff, limits);
        while (other.unfinished) other = fresh.expand(node, cutoff, limits);
        const auto summary = [](const Expansion& e) {
          std::string text = e.plan ? fmt::format("plan {}", e.plan->cost) : "no plan";
          for (const NodePtr& c : e.children)
            text += fmt::format(", child {}/{}", c->bound(), c->cost());
          return text;
        };
        ++counts.histories;
        if (summary(expansion) != summary(other)) {
          ++counts.histories_differ;
          if (counts.histories_differ <= 3)
            fmt::print("history: node {}/{} cutoff {}: {} | fresh: {}\n", node->bound(),
                       node->cost(), cutoff, summary(expansion), summary(other));
        }
      }
      if (expansion.plan && !valid(instance, *expansion.plan))
        fail(tiny, "an invalid plan", techniques, seed);
      if (expansion.plan && cutoff < kInfiniteCost && expansion.plan->cost < node->bound())
        fail(tiny, "a plan below its node's bound", techniques, seed);
      if (cutoff <= plan.cost) {
        ++counts.expansions_with_low_cutoff;
        for (const NodePtr& child : expansion.children) reached.push_back(child);
        continue;  // expands the same node again with a different cutoff
      }
      if (expansion.plan) {
        if (expansion.plan->cost > plan.cost)
          fail(tiny, "the plan of a node is not its best", techniques, seed);
        ++counts.finished;
        break;
      }
      std::vector<NodePtr> holding;
      for (const NodePtr& child : expansion.children) {
        reached.push_back(child);
        if (!holds(instance, *child, paths)) continue;
        holding.push_back(child);
        if (child->bound() > plan.cost)
          fail(tiny,
               fmt::format("a child that holds a plan of {} claims {}", plan.cost, child->bound()),
               techniques, seed);
      }
      if (holding.empty())
        fail(tiny, fmt::format("a plan of {} is lost with cutoff {}", plan.cost, cutoff),
             techniques, seed);
      node = random.pick(holding);
    }
    if (reached.size() > 3000) reached.resize(3000);
  }
}

Plan a_plan_of(const std::vector<Plan>& plans, const Plan& otherwise, Random& random) {
  return plans.empty() ? otherwise : random.pick(plans);
}

TinyInstance transformed(const TinyInstance& from, Random& random) {
  TinyInstance to = from;
  const int h = static_cast<int>(from.rows.size()), w = static_cast<int>(from.rows[0].size());
  const int kind = random.below(4);
  const auto move = [&](Position p) -> Position {
    switch (kind) {
      case 0:
        return {w - 1 - p.x, p.y};
      case 1:
        return {p.x, h - 1 - p.y};
      case 2:
        return {p.y, p.x};
      default:
        return {h - 1 - p.y, p.x};
    }
  };
  const auto turn = [&](Heading heading) {
    constexpr std::array<Position, 4> kAhead{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    const Position a = move({0, 0}), b = move(kAhead[static_cast<std::size_t>(heading)]);
    const Position ahead{b.x - a.x, b.y - a.y};
    return static_cast<Heading>(std::ranges::find(kAhead, ahead) - kAhead.begin());
  };
  to.rows = kind < 2 ? filled(w, h, '@') : filled(h, w, '@');
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const Position q = move({x, y});
      to.rows[q.y][q.x] = from.rows[y][x];
    }
  std::vector<int> order(from.agents.size());
  for (std::size_t a = 0; a < order.size(); ++a) order[a] = static_cast<int>(a);
  random.shuffle(order);  // order[a]: new index of agent a
  for (std::size_t a = 0; a < order.size(); ++a) {
    auto agent = from.agents[a];
    agent.start = move(agent.start);
    if (agent.goal) agent.goal = move(*agent.goal);
    if (agent.turn_steps > 0) agent.heading = turn(agent.heading);
    if (agent.turned > 0) agent.to = turn(agent.to);
    if (agent.goal_heading) agent.goal_heading = turn(*agent.goal_heading);
    to.agents[order[a]] = agent;
  }
  for (auto& road : to.roads) {
    road.from = move(road.from);
    road.to = move(road.to);
  }
  for (auto& task : to.tasks) {
    task.cell = move(task.cell);
    for (int& a : task.agents) a = order[a];
  }
  const auto at_work = [](const auto& agent) { return agent.work >= 0; };
  if (std::ranges::none_of(to.agents, at_work)) random.shuffle(to.tasks);
  return to;
}

void agree(const TinyInstance& tiny, const Instance& instance, std::uint64_t seed, Random& random,
           double seconds, Counts& counts) {
  SolveOptions base;
  base.omega = Omega::parse("0");
  std::optional<Cost> optimum;
  Cost best_bound = 0;
  Cost best_cost = kInfiniteCost;
  std::optional<Plan> best;
  bool infeasible = false;
  const auto judge = [&](const Solution& s, const Instance& of, Techniques t, const char* what) {
    ++counts.solves;
    if (s.plan && !valid(of, *s.plan)) fail(tiny, fmt::format("{}: wrong plan", what), t, seed);
    if (s.status == Status::kInfeasible) infeasible = true;
    if (s.plan) best_cost = std::min(best_cost, s.plan->cost);
    if (s.status != Status::kInfeasible) best_bound = std::max(best_bound, s.lower_bound);
    if (best_bound > best_cost)
      fail(tiny, fmt::format("{}: bound {} above a plan of {}", what, best_bound, best_cost), t,
           seed);
    if (infeasible && best_cost < kInfiniteCost)
      fail(tiny, fmt::format("{}: infeasible", what), t, seed);
    if (s.status != Status::kOptimal) return;
    ++counts.proven;
    if (optimum && *optimum != s.plan->cost)
      fail(tiny, fmt::format("{}: {} or {}", what, *optimum, s.plan->cost), t, seed);
    if (optimum) ++counts.agreements;
    optimum = s.plan->cost;
  };
  const Solution first = solve_for(instance, base, seconds);
  judge(first, instance, base.techniques, "all");
  if (first.status == Status::kInfeasible) ++counts.infeasible;
  if (!first.plan) {
    ++counts.unsolved;
  }
  for (int k = 0; k < 5; ++k) {
    SolveOptions options = base;
    options.seed = static_cast<std::uint64_t>(random.below(1000));
    switch (k) {
      case 0:
        options.policy = Policy::kFixed;
        break;
      case 1:
        options.techniques = Techniques{Technique::kStrongBranching, Technique::kBypass};
        break;
      default:
        options.techniques = random_techniques(random);
    }
    const TinyInstance other = k >= 2 && random.percent(60) ? transformed(tiny, random) : tiny;
    const Instance of = other.build();
    // Uses the first plan, or another plan that may cost more, as the start plan.
    if (other == tiny && first.plan && k >= 2 && random.percent(60))
      options.start = random.percent(40) ? *first.plan
                                         : a_plan_of(some_plans(tiny, instance, random, 3, 0.2),
                                                     *first.plan, random);
    if (first.status == Status::kOptimal && other == tiny && options.policy != Policy::kFixed) {
      PlantedOptimum planted(of, *first.plan);
      judge(solve_for(of, options, seconds, &planted), of, options.techniques, "watched");
      if (!planted.complaints().empty())
        fail(tiny, planted.complaints().front(), options.techniques, seed);
    } else {
      judge(solve_for(of, options, k == 0 ? seconds / 2 : seconds), of, options.techniques,
            k == 0 ? "fixed" : "other");
    }
  }
}

void against_oracle(const TinyInstance& tiny, const Instance& instance, std::uint64_t seed,
                    Random& random, double seconds, Counts& counts) {
  const oracle::Answer truth = oracle::solve_jointly(instance, 600'000);
  if (truth.verdict == oracle::Verdict::kTooLarge) return;
  ++counts.with_plans;
  if (!truth.plan) ++counts.infeasible;
  for (int k = 0; k < 3; ++k) {
    SolveOptions options;
    options.omega = Omega::parse("0");
    options.seed = static_cast<std::uint64_t>(random.below(1000));
    if (k > 0) options.techniques = random_techniques(random);
    if (k == 2 && truth.plan) options.start = truth.plan;
    ++counts.solves;
    std::optional<PlantedOptimum> planted;
    if (truth.plan) planted.emplace(instance, *truth.plan);
    const Solution s = solve_for(instance, options, truth.plan ? seconds : seconds / 10,
                                 planted ? &*planted : nullptr);
    if (planted && !planted->complaints().empty())
      fail(tiny, planted->complaints().front(), options.techniques, seed);
    if (s.plan && !valid(instance, *s.plan)) fail(tiny, "wrong plan", options.techniques, seed);
    if (s.plan && !truth.plan) fail(tiny, "a plan where there is none", options.techniques, seed);
    if (truth.plan) {
      if (s.status == Status::kInfeasible) fail(tiny, "infeasible", options.techniques, seed);
      if (s.lower_bound > truth.plan->cost)
        fail(tiny, fmt::format("bound {} > {}", s.lower_bound, truth.plan->cost),
             options.techniques, seed);
      if (s.plan && s.plan->cost < truth.plan->cost)
        fail(tiny, "below the optimum", options.techniques, seed);
      if (s.status == Status::kOptimal) {
        ++counts.proven;
        if (s.plan->cost != truth.plan->cost) fail(tiny, "wrong optimum", options.techniques, seed);
      } else
        ++counts.unsolved;
    }
  }
}

int main_of(int argc, char** argv) {
  CLI::App app("Tests relations between runs of the search, without an oracle.");
  std::string mode = "descend";
  std::int64_t count = 1000;
  std::uint64_t seed = 1;
  double seconds = 0.5, total = 60;
  bool tiny = false;
  app.add_option("--mode", mode);
  app.add_option("--count", count);
  app.add_option("--seed", seed);
  app.add_option("--patience", seconds);
  app.add_option("--seconds", total);
  app.add_flag("--tiny", tiny);
  std::string trace;
  app.add_option("--trace", trace);
  app.add_flag("--compare-histories", compare_histories);
  bool print = false;
  app.add_flag("--print-case", print, "print the instance of --seed and end");
  CLI11_PARSE(app, argc, argv);
  if (print) {
    Random random(seed ^ 0x5555);
    fmt::print("{}", draw(seed, tiny, random).to_text());
    return 0;
  }
  Counts counts;
  int failures = 0;
  const auto end = Limits::Clock::now() + std::chrono::duration_cast<Limits::Clock::duration>(
                                              std::chrono::duration<double>(total));
  for (std::int64_t k = 0; k < count && Limits::Clock::now() < end && failures < 5; ++k) {
    const std::uint64_t at = seed + static_cast<std::uint64_t>(k);
    Random random(at ^ 0x5555);
    const TinyInstance instance_text = draw(at, tiny, random);
    if (std::getenv("SHOW")) fmt::print(stderr, "SEED {}\n", at);
    if (!trace.empty()) std::ofstream(trace) << "# seed " << at << "\n" << instance_text.to_text();
    try {
      const Instance instance = instance_text.build();
      ++counts.instances;
      if (mode == "descend")
        descend(instance_text, instance, at, random, seconds, counts);
      else if (mode == "agree")
        agree(instance_text, instance, at, random, seconds, counts);
      else
        against_oracle(instance_text, instance, at, random, seconds, counts);
    } catch (const InstanceError& e) {
    } catch (const std::exception& error) {
      ++failures;
      fmt::print("FAILURE at seed {}:\n{}\n{}\n", at, error.what(), instance_text.to_text());
      std::fflush(stdout);
    }
  }
  fmt::print(
      "{} {}: instances {}, with plans {}, plans {}, descents {}, expansions {} (low cutoff {}), "
      "finished {}, solves {}, proven {}, agreements {}, infeasible {}, unsolved {}, histories {} "
      "of which {} differ; {} failures\n",
      mode, seed, counts.instances, counts.with_plans, counts.plans, counts.descents,
      counts.expansions, counts.expansions_with_low_cutoff, counts.finished, counts.solves,
      counts.proven, counts.agreements, counts.infeasible, counts.unsolved, counts.histories,
      counts.histories_differ, failures);
  return failures > 0;
}

}  // namespace
}  // namespace grove::detail::fuzz

int main(int argc, char** argv) {
  return grove::detail::fuzz::main_of(argc, argv);
}
