// SPDX-License-Identifier: MIT
#include "tests/planning/free_reference.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace grove::testing {
namespace {

// (cell, stops counted, the last one of them or -1)
using Place = std::tuple<Cell, unsigned, int>;

class Layers {
 public:
  explicit Layers(const FreeProblem& problem) : problem_(problem) {
    if (!barred(problem.start, 0)) reach(problem.start, 0, -1);
    now_.swap(next_);
  }

  bool finished(Time time) const {
    const unsigned all = (1U << problem_.stops.size()) - 1;
    return std::ranges::any_of(now_, [&](const Place& place) {
      const auto [cell, counted, last] = place;
      if (counted != all || !may_rest(cell, time)) return false;
      return problem_.destination ? cell == *problem_.destination : problem_.stops[last] == cell;
    });
  }

  // False if nothing changes any more.
  bool step(Time time) {
    next_.clear();
    for (const auto& [cell, counted, last] : now_) {
      if (!barred(cell, time)) reach(cell, counted, last);
      for (Cell to : problem_.grid->neighbors(cell))
        if (!barred(to, time) && !move_barred(cell, to, time)) reach(to, counted, last);
    }
    now_.swap(next_);
    return time <= last_change() || now_ != next_;
  }

 private:
  bool barred(Cell cell, Time time) const {
    return std::ranges::any_of(problem_.constraints, [&](const Constraint& c) {
      return !c.is_move() && c.cell == cell && c.begin <= time && time <= c.end;
    });
  }
  bool move_barred(Cell from, Cell to, Time time) const {
    return std::ranges::any_of(problem_.constraints, [&](const Constraint& c) {
      return c.is_move() && c.from == from && c.cell == to && c.begin <= time && time <= c.end;
    });
  }
  bool may_rest(Cell cell, Time time) const {
    return std::ranges::none_of(problem_.constraints, [&](const Constraint& c) {
      return !c.is_move() && c.cell == cell && c.begin <= c.end && c.end >= time;
    });
  }
  Time last_change() const {
    Time last = 0;
    for (const Constraint& c : problem_.constraints)
      last = std::max({last, c.begin + 1, c.end >= kNever ? 0 : c.end + 1});
    return last;
  }

  bool may_follow(unsigned counted, int stop) const {
    const SequenceClass& work = problem_.work;
    const auto position = static_cast<std::size_t>(__builtin_popcount(counted));
    if ((counted >> stop & 1) != 0) return false;
    if (position < work.prefix.size()) return work.prefix[position] == stop;
    return position > work.prefix.size() || (work.forbidden_next >> stop & 1) == 0;
  }

  void reach(Cell cell, unsigned counted, int last) {
    next_.insert({cell, counted, last});
    for (int stop = 0; stop < static_cast<int>(problem_.stops.size()); ++stop)
      if (problem_.stops[stop] == cell && may_follow(counted, stop))
        next_.insert({cell, counted | 1U << stop, stop});
  }

  const FreeProblem& problem_;
  std::set<Place> now_;
  std::set<Place> next_;
};

}  // namespace

std::optional<Time> free_reference_cost(const FreeProblem& problem) {
  Layers layers(problem);
  for (Time t = 0;; ++t) {
    if (layers.finished(t)) return t;
    if (!layers.step(t + 1)) return std::nullopt;
  }
}

std::vector<Sequence> members_of(const SequenceClass& work, int n) {
  std::vector<Sequence> members;
  Sequence order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Stop{0});
  do {
    const std::size_t length = work.prefix.size();
    const bool fits = std::equal(work.prefix.begin(), work.prefix.end(), order.begin());
    if (fits && (length == order.size() || (work.forbidden_next >> order[length] & 1) == 0))
      members.push_back(order);
  } while (std::ranges::next_permutation(order).found);
  return members;
}

}  // namespace grove::testing
