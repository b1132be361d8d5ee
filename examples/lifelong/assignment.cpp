// SPDX-License-Identifier: MIT
#include "assignment.h"

#include <algorithm>
#include <limits>
#include <set>

namespace lifelong {
namespace {

constexpr int kFar = std::numeric_limits<int>::max();

// Distances from all cells to one cell in steps, by breadth-first search; kFar if no path exists.
class DistanceField {
 public:
  DistanceField(const grove::World& world, grove::Cell to)
      : width_(world.width()),
        steps_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(world.height()), kFar) {
    std::deque<grove::Cell> next{to};
    at(to) = 0;
    for (; !next.empty(); next.pop_front()) {
      const auto [x, y] = next.front();
      for (const grove::Cell cell : {grove::Cell{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}}) {
        if (!world.passable(cell) || at(cell) < kFar) continue;
        at(cell) = at({x, y}) + 1;
        next.push_back(cell);
      }
    }
  }
  int from(const grove::Agent& robot) { return at(std::get<grove::Cell>(robot.start.place)); }

 private:
  int& at(grove::Cell cell) { return steps_[static_cast<std::size_t>(cell.y * width_ + cell.x)]; }

  int width_;
  std::vector<int> steps_;
};

// Returns the robots without a task.
std::vector<const grove::Agent*> free_robots(const grove::Instance& now) {
  std::set<std::string> busy;
  for (const grove::Task& task : now.tasks()) busy.insert(task.agents.begin(), task.agents.end());
  std::vector<const grove::Agent*> free;
  for (const grove::Agent& robot : now.agents())
    if (!busy.contains(robot.id)) free.push_back(&robot);
  return free;
}

}  // namespace

Given Assignment::give_to_any(const grove::Instance& now, std::size_t max_tasks) {
  Given given;
  while (!open_.empty() && now.tasks().size() + given.size() < max_tasks) {
    given.emplace_back("", open_.front());
    open_.pop_front();
  }
  return given;
}

Given Assignment::give_to_nearest(const grove::Instance& now) {
  std::set<std::string> taken;
  for (const grove::Task& task : now.tasks()) taken.insert(to_string(task.place));
  std::vector<const grove::Agent*> free = free_robots(now);
  Given given;
  for (auto errand = open_.begin(); errand != open_.end() && !free.empty();) {
    if (!taken.insert(to_string(grove::Place{errand->cell})).second) {
      ++errand;
      continue;
    }
    DistanceField distances(world_, errand->cell);
    const auto nearest = std::ranges::min_element(
        free, {}, [&](const auto* robot) { return distances.from(*robot); });
    given.emplace_back((*nearest)->id, *errand);
    free.erase(nearest);
    errand = open_.erase(errand);
  }
  return given;
}

}  // namespace lifelong
