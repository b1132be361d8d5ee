// SPDX-License-Identifier: MIT
#include "tests/fuzz/shrink.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace grove::detail::fuzz {
namespace {

TinyInstance without_task(TinyInstance instance, std::size_t task) {
  instance.tasks.erase(instance.tasks.begin() + static_cast<std::ptrdiff_t>(task));
  for (auto& agent : instance.agents) {
    if (agent.work == static_cast<int>(task)) agent.work = -1;
    if (agent.work > static_cast<int>(task)) --agent.work;
    if (agent.work < 0) agent.done = 0;
  }
  return instance;
}

TinyInstance without_agent(TinyInstance instance, int agent) {
  instance.agents.erase(instance.agents.begin() + agent);
  for (auto& task : instance.tasks) {
    std::erase(task.agents, agent);
    for (int& a : task.agents)
      if (a > agent) --a;
  }
  for (std::size_t t = instance.tasks.size(); t-- > 0;)
    if (instance.tasks[t].agents.empty()) instance = without_task(std::move(instance), t);
  return instance;
}

TinyInstance without_share(TinyInstance instance, std::size_t task, int agent) {
  std::erase(instance.tasks[task].agents, agent);
  return instance;
}

// Applies `move` to all positions of agents, tasks and roads.
void move_all(TinyInstance& instance, const std::function<void(Position&)>& move) {
  for (auto& agent : instance.agents) {
    move(agent.start);
    if (agent.goal) move(*agent.goal);
  }
  for (auto& task : instance.tasks) move(task.cell);
  for (auto& road : instance.roads) {
    move(road.from);
    move(road.to);
  }
}

// Removes the roads at removed cells. Returns false if this removes all roads.
bool drop_roads(TinyInstance& instance, const std::function<bool(Position)>& is_gone) {
  if (instance.roads.empty()) return true;
  std::erase_if(instance.roads,
                [&](const auto& road) { return is_gone(road.from) || is_gone(road.to); });
  return !instance.roads.empty();
}

// Returns the instance without this row and the roads at its cells. Returns nullopt if an agent or
// task uses a cell of the row, or if no road would remain.
std::optional<TinyInstance> without_row(TinyInstance instance, int row) {
  for (int x = 0; x < static_cast<int>(instance.rows[row].size()); ++x)
    if (in_use(instance, {x, row})) return std::nullopt;
  if (!drop_roads(instance, [row](Position p) { return p.y == row; })) return std::nullopt;
  instance.rows.erase(instance.rows.begin() + row);
  move_all(instance, [row](Position& p) { p.y -= p.y > row; });
  return instance;
}

std::optional<TinyInstance> without_column(TinyInstance instance, int column) {
  for (int y = 0; y < static_cast<int>(instance.rows.size()); ++y)
    if (in_use(instance, {column, y})) return std::nullopt;
  if (!drop_roads(instance, [column](Position p) { return p.x == column; })) return std::nullopt;
  for (auto& row : instance.rows) row.erase(row.begin() + column);
  move_all(instance, [column](Position& p) { p.x -= p.x > column; });
  return instance;
}

class Steps {
 public:
  explicit Steps(const FuzzCase& from) : from_(from) {}

  std::vector<FuzzCase> all() {
    drop_agents();
    drop_tasks();
    drop_rows_and_columns();
    simplify_roads();
    simplify_agents();
    simplify_work();
    plainer_options();
    block_cells();
    return std::move(cases_);
  }

 private:
  void offer(FuzzCase candidate) {
    try {
      (void)candidate.build();
    } catch (const std::invalid_argument&) {
      return;  // invalid, for instance because the road on which an agent starts is gone
    }
    cases_.push_back(std::move(candidate));
  }

  void offer(std::optional<TinyInstance> instance) {
    if (!instance) return;
    FuzzCase candidate = from_;
    candidate.instance = *std::move(instance);
    offer(std::move(candidate));
  }

  void drop_agents() {
    for (int a = 0; a < static_cast<int>(from_.instance.agents.size()); ++a)
      offer(without_agent(from_.instance, a));
  }

  void drop_tasks() {
    for (std::size_t t = 0; t < from_.instance.tasks.size(); ++t) {
      offer(without_task(from_.instance, t));
      for (int agent : from_.instance.tasks[t].agents)
        offer(without_share(from_.instance, t, agent));
    }
  }

  void drop_rows_and_columns() {
    const auto& rows = from_.instance.rows;
    for (int y = 0; y < static_cast<int>(rows.size()); ++y) offer(without_row(from_.instance, y));
    for (int x = 0; x < static_cast<int>(rows[0].size()); ++x)
      offer(without_column(from_.instance, x));
  }

  void simplify_roads() {
    const auto& roads = from_.instance.roads;
    for (std::size_t r = 0; r < roads.size(); ++r) {
      TinyInstance fewer = from_.instance;
      fewer.roads.erase(fewer.roads.begin() + static_cast<std::ptrdiff_t>(r));
      if (!fewer.roads.empty()) offer(std::move(fewer));
      const TinyInstance::Road plain{roads[r].from, roads[r].to, 1, false};
      if (roads[r] == plain) continue;
      TinyInstance plainer = from_.instance;
      plainer.roads[r] = plain;
      offer(std::move(plainer));
    }
  }

  // Adds the instance in which `change` is applied to agent `a`, if it differs from the original.
  template <typename Change>
  void change_agent(std::size_t a, Change change) {
    TinyInstance plainer = from_.instance;
    change(plainer.agents[a]);
    if (plainer != from_.instance) offer(std::move(plainer));
  }

  void simplify_agents() {
    using Agent = TinyInstance::Agent;
    for (std::size_t a = 0; a < from_.instance.agents.size(); ++a) {
      change_agent(a, [](Agent& agent) {
        agent.turn_steps = agent.turned = 0;
        agent.heading = agent.to = Heading::kNorth;
        agent.goal_heading.reset();
      });
      change_agent(a, [](Agent& agent) {
        agent.turned = 0;
        agent.to = Heading::kNorth;
      });
      change_agent(a, [](Agent& agent) {
        if (agent.turn_steps > 1) --agent.turn_steps;
      });
      change_agent(a, [](Agent& agent) { agent.goal_heading.reset(); });
      change_agent(a, [](Agent& agent) {
        agent.work = -1;
        agent.done = 0;
      });
      change_agent(a, [](Agent& agent) { agent.done = 0; });
      change_agent(a, [](Agent& agent) {
        agent.road = -1;
        agent.along = 0;
      });
    }
  }

  void simplify_work() {
    for (std::size_t t = 0; t < from_.instance.tasks.size(); ++t)
      for (const Time duration : {0, from_.instance.tasks[t].duration - 1}) {
        if (duration < 0 || duration == from_.instance.tasks[t].duration) continue;
        TinyInstance plainer = from_.instance;
        plainer.tasks[t].duration = duration;
        offer(std::move(plainer));
      }
  }

  template <typename T>
  void plainer(T& (*option)(FuzzCase&), T plain) {
    FuzzCase candidate = from_;
    if (option(candidate) == plain) return;
    option(candidate) = plain;
    offer(std::move(candidate));
  }

  void plainer_number(const Tunable& t) {
    FuzzCase candidate = from_;
    set(candidate.options.tuning, t.name() + "=" + t.value({}));
    if (candidate.options.tuning != from_.options.tuning) offer(std::move(candidate));
  }

  void plainer_options() {
    plainer<ImposedLimit>([](FuzzCase& c) -> ImposedLimit& { return c.limit; },
                          ImposedLimit::kNothing);
    plainer<std::size_t>([](FuzzCase& c) -> std::size_t& { return c.options.node_memory; },
                         SolveOptions::kUnlimited);
    plainer<Tuning>([](FuzzCase& c) -> Tuning& { return c.options.tuning; }, {});
    for (const Tunable& t : tunables()) plainer_number(t);
    plainer<Policy>([](FuzzCase& c) -> Policy& { return c.options.policy; }, Policy::kAuto);
    plainer<RtspBackend>([](FuzzCase& c) -> RtspBackend& { return c.options.rtsp; },
                         RtspBackend::kAuto);
    plainer<Omega>([](FuzzCase& c) -> Omega& { return c.options.omega; }, Omega());
    plainer<std::uint64_t>([](FuzzCase& c) -> std::uint64_t& { return c.options.seed; }, 0);
  }

  void block_cells() {
    const auto& rows = from_.instance.rows;
    for (int y = 0; y < static_cast<int>(rows.size()); ++y) {
      for (int x = 0; x < static_cast<int>(rows[y].size()); ++x) {
        if (rows[y][x] != '.' || in_use(from_.instance, {x, y})) continue;
        TinyInstance blocked = from_.instance;
        blocked.rows[y][x] = '@';
        if (drop_roads(blocked, [&](Position p) { return p == Position{x, y}; }))
          offer(std::move(blocked));
      }
    }
  }

  const FuzzCase& from_;
  std::vector<FuzzCase> cases_;
};

}  // namespace

std::vector<FuzzCase> simpler_cases(const FuzzCase& fuzz_case) {
  return Steps(fuzz_case).all();
}

FuzzCase shrink(FuzzCase fuzz_case, const std::function<bool(const FuzzCase&)>& fails,
                const Limits& limits) {
  for (bool shrunk = true; shrunk;) {
    shrunk = false;
    for (FuzzCase& simpler : simpler_cases(fuzz_case)) {
      if (limits.stop_requested()) return fuzz_case;
      if (!fails(simpler)) continue;
      fuzz_case = std::move(simpler);
      shrunk = true;
      break;
    }
  }
  return fuzz_case;
}

}  // namespace grove::detail::fuzz
