// SPDX-License-Identifier: MIT
#include "tests/fuzz/random_instance.h"

#include <algorithm>
#include <cmath>

#include "tests/fuzz/random.h"
#include "tests/fuzz/random_map.h"

namespace grove::detail::fuzz {
namespace {

// Approximate limit on the joint moves of an instance, so that the oracle stays fast even if there
// is no plan.
constexpr double kMaxJointMoves = 2e7;
constexpr int kMaxTasksEach = 4;

bool adjacent(Position p, Position q) {
  return std::abs(p.x - q.x) + std::abs(p.y - q.y) == 1;
}

class Maker {
 public:
  Maker(std::uint64_t seed, int agents, bool roads)
      : random_(seed), wanted_agents_(agents), roads_(roads) {}

  TinyInstance make() {
    instance_.rows = random_map(static_cast<Shape>(random_.below(kShapeCount)), random_);
    cells_ = passable_cells(instance_.rows);
    places_ = static_cast<int>(cells_.size());
    if (roads_) add_roads();
    place_agents();
    // Most instances come from random moves, which guarantee that each agent can reach its tasks
    // and destination.
    if (random_.percent(70))
      play();
    else
      draw_goals();
    make_mg();
    add_tasks();
    return instance_;
  }

 private:
  // Adds roads between nearly all pairs of adjacent cells, and up to two roads between random
  // cells. Some roads are long or one-way, and some can be parallel.
  void add_roads() {
    for (const Position p : cells_)
      for (const Position q : cells_)
        if (adjacent(p, q) && (p.x < q.x || p.y < q.y) && !random_.percent(4)) add_road(p, q);
    for (int more = random_.below(3); more > 0; --more)
      add_road(random_.pick(cells_), random_.pick(cells_));
  }

  void add_road(Position p, Position q) {
    if (random_.percent(50)) std::swap(p, q);
    const Time steps = random_.percent(65) ? 1 : random_.between(2, 4);
    const bool one_way = random_.percent(20);
    if (p == q) return;
    instance_.roads.push_back({p, q, steps, one_way});
    places_ += steps - 1;
  }

  bool joined(Position from, Position to) const {
    if (!roads_) return adjacent(from, to);
    return std::ranges::any_of(instance_.roads, [&](const TinyInstance::Road& r) {
      return (r.from == from && r.to == to) || (!r.one_way && r.from == to && r.to == from);
    });
  }

  // Returns the cells that are reachable from `from`.
  std::vector<Position> component(Position from) const {
    std::vector<Position> found{from};
    for (std::size_t head = 0; head < found.size(); ++head)
      for (Position p : cells_)
        if (joined(found[head], p) && std::ranges::count(found, p) == 0) found.push_back(p);
    return found;
  }

  int agent_count() {
    if (wanted_agents_ > 0) return wanted_agents_;
    const int dice = random_.below(100);
    return dice < 8 ? 1 : dice < 50 ? 2 : dice < 85 ? 3 : 4;
  }

  void place_agents() {
    const int count = std::min(agent_count(), static_cast<int>(cells_.size()) - 1);
    std::vector<Position> starts = cells_;
    random_.shuffle(starts);
    for (int a = 0; a < count; ++a) instance_.agents.push_back({starts[a], starts[a]});
    reach_.resize(instance_.agents.size());
    tasks_of_.assign(instance_.agents.size(), 0);
  }

  // Moves the agents at random: their final cells become destinations, and the cells that they
  // visit are possible task cells.
  void play() {
    const int agents = static_cast<int>(instance_.agents.size());
    for (int a = 0; a < agents; ++a) reach_[a] = {instance_.agents[a].start};
    for (int moves = random_.between(5, 150) * agents; moves > 0; --moves) {
      const int a = random_.below(agents);
      const Position to = random_.pick(cells_);
      if (!joined(*instance_.agents[a].goal, to) || is_goal(to)) continue;
      instance_.agents[a].goal = to;
      reach_[a].push_back(to);
    }
  }

  // Sets random destinations and possible task cells. Only a fifth of the calls can choose
  // unreachable ones, because presolve detects these.
  void draw_goals() {
    const bool everywhere = random_.percent(20);
    for (auto& agent : instance_.agents) agent.goal.reset();
    for (std::size_t a = 0; a < instance_.agents.size(); ++a) {
      auto& agent = instance_.agents[a];
      reach_[a] = everywhere ? cells_ : component(agent.start);
      std::vector<Position> free = reach_[a];
      std::erase_if(free, [&](Position p) { return is_goal(p); });
      if (!free.empty()) agent.goal = random_.pick(free);
    }
  }

  bool is_goal(Position p) const {
    return std::ranges::any_of(instance_.agents, [&](const auto& a) { return a.goal == p; });
  }

  // Turns all, some or no agents into MG agents, each with its destination as an additional task.
  // An agent without a destination always becomes an MG agent, with a random task.
  void make_mg() {
    constexpr int kChances[] = {0, 50, 100};
    const int chance = kChances[random_.below(3)];
    for (std::size_t a = 0; a < instance_.agents.size(); ++a) {
      auto& goal = instance_.agents[a].goal;
      if (goal && !random_.percent(chance)) continue;
      give(static_cast<int>(a), goal ? *goal : random_.pick(reach_[a]));
      goal.reset();
    }
  }

  // Returns a random task cell for `agent`. In half of the calls it prefers the start or
  // destination of a random agent, if `agent` can have a task there.
  Position task_cell(int agent) {
    const Position any = random_.pick(reach_[agent]);
    if (random_.percent(50)) return any;
    const auto& other = random_.pick(instance_.agents);
    const Position cell = other.goal && random_.percent(50) ? *other.goal : other.start;
    return std::ranges::count(reach_[agent], cell) > 0 ? cell : any;
  }

  bool has_room(int agent) const {
    double moves = 1;
    int tasks = 1;
    for (std::size_t a = 0; a < instance_.agents.size(); ++a) {
      moves *= 4 * (places_ - static_cast<double>(a));
      tasks += tasks_of_[a];
    }
    return tasks_of_[agent] < kMaxTasksEach && std::ldexp(moves, tasks) <= kMaxJointMoves;
  }

  // Adds a task on `cell` for `agent`, or adds the agent to a task that is already there.
  void give(int agent, Position cell) {
    auto task =
        std::ranges::find_if(instance_.tasks, [&](const auto& t) { return t.cell == cell; });
    if (task == instance_.tasks.end())
      task = instance_.tasks.insert(task, TinyInstance::Task{cell, {}});
    if (std::ranges::count(task->agents, agent) > 0) return;
    task->agents.push_back(agent);
    ++tasks_of_[agent];
  }

  void add_tasks() {
    const int tries = random_.percent(15) ? 0 : random_.between(1, 9);
    for (int k = 0; k < tries; ++k) {
      const int agent = random_.below(static_cast<int>(instance_.agents.size()));
      if (!has_room(agent)) continue;
      give(agent, task_cell(agent));
    }
  }

  Random random_;
  int wanted_agents_;
  bool roads_;
  TinyInstance instance_;
  int places_ = 0;
  std::vector<Position> cells_;
  std::vector<std::vector<Position>> reach_;  // by agent: possible cells of its tasks
  std::vector<int> tasks_of_;                 // by agent: number of tasks
};

}  // namespace

TinyInstance random_instance(std::uint64_t seed) {
  return Maker(seed, 0, false).make();
}

TinyInstance random_instance(std::uint64_t seed, int agents) {
  return Maker(seed, agents, false).make();
}

TinyInstance random_roads(std::uint64_t seed) {
  return Maker(seed, 0, true).make();
}

}  // namespace grove::detail::fuzz
