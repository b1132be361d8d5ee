// SPDX-License-Identifier: MIT
#include "tests/planning/reference_search.h"

#include <algorithm>
#include <limits>

namespace grove::testing {
namespace {

constexpr int kUnreached = std::numeric_limits<int>::max();

bool barred(const Problem& problem, Cell cell, Time time) {
  return std::ranges::any_of(problem.constraints, [&](const Constraint& c) {
    return !c.is_move() && c.cell == cell && c.begin <= time && time <= c.end;
  });
}

bool move_barred(const Problem& problem, Cell from, Cell to, Time time) {
  return std::ranges::any_of(problem.constraints, [&](const Constraint& c) {
    return c.is_move() && c.from == from && c.cell == to && c.begin <= time && time <= c.end;
  });
}

bool may_rest(const Problem& problem, Cell cell, Time time) {
  return std::ranges::none_of(problem.constraints, [&](const Constraint& c) {
    return !c.is_move() && c.cell == cell && c.begin <= c.end && c.end >= time;
  });
}

// From here on nothing changes any more.
Time time_of_last_change(const Problem& problem) {
  Time last = 0;
  for (const Constraint& c : problem.constraints)
    last = std::max({last, c.begin + 1, c.end >= kNever ? 0 : c.end + 1});
  return last;
}

// Fewest conflicts to each (cell, visited) at one time, step by step.
class Layers {
 public:
  Layers(const Problem& problem, const NaiveConflicts& others)
      : problem_(problem), others_(others), width_(problem.goals.size() + 1) {
    now_.assign(problem.grid->cell_count() * width_, kUnreached);
    if (!barred(problem, problem.start, 0)) reach(now_, problem.start, 0, 0);
  }

  int conflicts(Cell cell, std::size_t visited) const { return now_[cell * width_ + visited]; }

  void step(Time time) {
    std::vector<int> next(now_.size(), kUnreached);
    for (Cell cell = 0; cell < problem_.grid->cell_count(); ++cell)
      for (std::size_t visited = 0; visited < width_; ++visited)
        if (conflicts(cell, visited) != kUnreached) leave(next, cell, visited, time);
    now_ = std::move(next);
  }

 private:
  void leave(std::vector<int>& next, Cell cell, std::size_t visited, Time time) {
    const auto go = [&](Cell to) {
      if (barred(problem_, to, time)) return;
      if (to != cell && move_barred(problem_, cell, to, time)) return;
      reach(next, to, visited, conflicts(cell, visited) + others_.conflicts(cell, to, time));
    };
    go(cell);
    for (Cell to : problem_.grid->neighbors(cell)) go(to);
  }

  void reach(std::vector<int>& layer, Cell cell, std::size_t visited, int conflicts) {
    for (;; ++visited) {
      int& best = layer[cell * width_ + visited];
      best = std::min(best, conflicts);
      if (visited + 1 == width_ || problem_.goals[visited] != cell) return;
    }
  }

  const Problem& problem_;
  const NaiveConflicts& others_;
  std::size_t width_;
  std::vector<int> now_;
};

}  // namespace

std::optional<Time> reference_cost(const Problem& problem) {
  const NaiveConflicts nobody;
  Layers layers(problem, nobody);
  const Cell last = problem.goals.back();
  const Time states = problem.grid->cell_count() * static_cast<Time>(problem.goals.size() + 1);
  const Time horizon = time_of_last_change(problem) + states;
  for (Time t = 0; t <= horizon; layers.step(++t))
    if (layers.conflicts(last, problem.goals.size()) != kUnreached && may_rest(problem, last, t))
      return t;
  return std::nullopt;
}

int reference_conflicts(const Problem& problem, const NaiveConflicts& others, Time cost) {
  Layers layers(problem, others);
  for (Time t = 1; t <= cost; ++t) layers.step(t);
  const Cell last = problem.goals.back();
  return layers.conflicts(last, problem.goals.size()) + others.conflicts_of_resting(last, cost);
}

std::string path_error(const Problem& problem, const Path& path) {
  if (path.empty() || path.front() != problem.start) return "does not begin at the start";
  if (path.back() != problem.goals.back()) return "does not end at the last goal";
  const auto cost = static_cast<Time>(path.size() - 1);
  std::size_t visited = 0;
  for (Time t = 0; t <= cost; ++t) {
    const std::string when = " at time " + std::to_string(t);
    if (!problem.grid->passable(path[t])) return "on a blocked cell" + when;
    if (barred(problem, path[t], t)) return "on a barred cell" + when;
    while (visited < problem.goals.size() && problem.goals[visited] == path[t]) ++visited;
    if (t == 0 || path[t] == path[t - 1]) continue;
    if (std::ranges::count(problem.grid->neighbors(path[t - 1]), path[t]) == 0)
      return "jumps" + when;
    if (move_barred(problem, path[t - 1], path[t], t)) return "makes a barred move" + when;
  }
  if (visited < problem.goals.size()) return "misses goal " + std::to_string(visited);
  if (!may_rest(problem, path.back(), cost)) return "rests where it is barred later";
  return "";
}

Cell NaiveConflicts::at(const Path& path, Time time) {
  return path[std::min<std::size_t>(time, path.size() - 1)];
}

int NaiveConflicts::conflicts(Cell from, Cell to, Time time) const {
  int count = 0;
  for (const Path& path : paths) {
    count += static_cast<int>(at(path, time) == to);
    if (from != to) count += static_cast<int>(at(path, time) == from && at(path, time - 1) == to);
  }
  return count;
}

int NaiveConflicts::conflicts_of_resting(Cell cell, Time time) const {
  int count = 0;
  for (const Path& path : paths) {
    const auto rest = static_cast<Time>(path.size() - 1);
    for (Time t = time + 1; t <= rest; ++t) count += static_cast<int>(path[t] == cell);
    if (rest <= time && path.back() == cell) ++count;
  }
  return count;
}

int NaiveConflicts::conflicts(const Path& path) const {
  int count = 0;
  for (std::size_t t = 1; t < path.size(); ++t)
    count += conflicts(path[t - 1], path[t], static_cast<Time>(t));
  return count + conflicts_of_resting(path.back(), static_cast<Time>(path.size() - 1));
}

}  // namespace grove::testing
