// SPDX-License-Identifier: MIT
#include "tests/planning/reference_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tests/planning/step_rules.h"
#include "tests/support/satisfies.h"

namespace grove::detail::testing {
namespace {

constexpr int kUnreached = std::numeric_limits<int>::max();

// State of an agent at one time.
struct State {
  Cell cell;
  std::size_t visited;
  std::size_t mouth;  // entrance by which it entered its corridor: index in Layers::mouths_
  bool late;          // it arrived late: StepRules::is_late()
};

// Computes the fewest conflicts of a path to each state, one layer per time step.
class Layers {
 public:
  Layers(const Problem& problem, const NaiveConflicts& others)
      : problem_(problem),
        others_(others),
        rules_(*problem.grid, problem.constraints),
        width_(problem.goals.size() + 1) {
    find_mouths();
    now_.assign(problem.grid->cell_count() * width_ * mouths_.size() * 2, kUnreached);
    if (!rules_.barred(problem.start, 0))
      reach(now_, {problem.start, 0, 0, rules_.is_late(problem.start, 0)}, 0);
  }

  // Returns the fewest conflicts of a path that has visited all goals and rests on the last goal
  // from `time` on.
  int conflicts_at_rest(Time time) const {
    const Cell cell = problem_.goals.back();
    int fewest = kUnreached;
    if (!rules_.may_rest(cell, time)) return fewest;
    for (std::size_t mouth = 0; mouth < mouths_.size(); ++mouth)
      fewest = std::min(fewest, now_[index({cell, width_ - 1, mouth, true})]);
    return fewest;
  }

  // Advances to `time`. Returns false if the layers can no longer change.
  bool step(Time time) {
    std::vector<int> next(now_.size(), kUnreached);
    for (Cell cell = 0; cell < problem_.grid->cell_count(); ++cell)
      for (std::size_t visited = 0; visited < width_; ++visited)
        for (std::size_t mouth = 0; mouth < mouths_.size(); ++mouth)
          for (const bool late : {false, true}) leave(next, {cell, visited, mouth, late}, time);
    now_.swap(next);
    return time <= rules_.last_change() || now_ != next;
  }

 private:
  // Lists the entrances of corridors if a constraint depends on them. Index 0 means "none".
  void find_mouths() {
    if (std::ranges::none_of(problem_.constraints, [](const Constraint& c) {
          return c.kind == ConstraintKind::kNoTraversal;
        }))
      return;
    for (Cell end = 0; end < problem_.grid->cell_count(); ++end)
      for (Cell inner : problem_.grid->neighbors(end))
        if (is_mouth(*problem_.grid, end, inner)) mouths_.push_back({end, inner});
  }

  std::size_t index(const State& s) const {
    return ((s.cell * width_ + s.visited) * mouths_.size() + s.mouth) * 2 +
           static_cast<std::size_t>(s.late);
  }

  void leave(std::vector<int>& next, const State& from, Time time) {
    const int so_far = now_[index(from)];
    if (so_far == kUnreached) return;
    const auto go = [&](const State& to) {
      if (!rules_.barred(to.cell, time))
        reach(next, to, so_far + others_.conflicts(from.cell, to.cell, time));
    };
    go(from);
    const Mouth mouth = mouths_[from.mouth];
    for (Cell to : problem_.grid->neighbors(from.cell)) {
      if (rules_.move_barred(from.cell, to, mouth, time)) continue;
      const auto after = std::ranges::find(mouths_, rules_.mouth_after(from.cell, to, mouth));
      const std::size_t number = after == mouths_.end() ? 0 : after - mouths_.begin();
      go({to, from.visited, number, rules_.is_late(to, time)});
    }
  }

  void reach(std::vector<int>& layer, State state, int conflicts) {
    for (;; ++state.visited) {
      int& best = layer[index(state)];
      best = std::min(best, conflicts);
      if (state.visited + 1 == width_ || problem_.goals[state.visited] != state.cell) return;
    }
  }

  const Problem& problem_;
  const NaiveConflicts& others_;
  const StepRules rules_;
  std::size_t width_;
  std::vector<Mouth> mouths_{Mouth{}};
  std::vector<int> now_;
};

}  // namespace

std::optional<Time> reference_cost(const Problem& problem) {
  const NaiveConflicts none;
  Layers layers(problem, none);
  for (Time t = 0;; ++t) {
    if (layers.conflicts_at_rest(t) != kUnreached) return t;
    if (!layers.step(t + 1)) return std::nullopt;
  }
}

int reference_conflicts(const Problem& problem, const NaiveConflicts& others, Time cost) {
  Layers layers(problem, others);
  for (Time t = 1; t <= cost; ++t) layers.step(t);
  return layers.conflicts_at_rest(cost) + others.conflicts_of_resting(problem.goals.back(), cost);
}

std::string path_error(const Problem& problem, const Path& path) {
  if (path.empty() || path.front() != problem.start) return "does not begin at the start";
  if (path.back() != problem.goals.back()) return "does not end at the last goal";
  std::size_t visited = 0;
  for (Time t = 0; t < static_cast<Time>(path.size()); ++t) {
    const std::string when = fmt::format(" at time {}", t);
    if (!problem.grid->passable(path[t])) return "on a blocked cell" + when;
    while (visited < problem.goals.size() && problem.goals[visited] == path[t]) ++visited;
    if (t > 0 && path[t] != path[t - 1] &&
        std::ranges::count(problem.grid->neighbors(path[t - 1]), path[t]) == 0)
      return "jumps" + when;
  }
  if (visited < problem.goals.size()) return fmt::format("misses goal {}", visited);
  for (std::size_t i = 0; i < problem.constraints.size(); ++i)
    if (!satisfies(*problem.grid, path, problem.constraints[i]))
      return fmt::format("breaks constraint {}", i);
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

}  // namespace grove::detail::testing
