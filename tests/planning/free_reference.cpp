// SPDX-License-Identifier: MIT
#include "tests/planning/free_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

#include "tests/planning/reference_search.h"
#include "tests/planning/step_rules.h"

namespace grove::detail::testing {
namespace {

struct FreePlace {
  Cell cell;
  unsigned counted;  // bit i: stop i is counted as visited
  int last;          // the stop counted last; -1: none
  Mouth mouth;       // entrance by which it entered its corridor; none: see StepRules
  bool late;         // it arrived late: StepRules::is_late()

  auto key() const { return std::tuple(cell, counted, last, mouth.end, mouth.inner, late); }
  bool operator<(const FreePlace& other) const { return key() < other.key(); }
  bool operator==(const FreePlace& other) const { return key() == other.key(); }
};

class FreeLayers {
 public:
  explicit FreeLayers(const FreeProblem& problem)
      : problem_(problem), rules_(*problem.grid, problem.constraints) {
    if (!barred(problem.start, 0))
      reach({problem.start, 0, -1, {}, rules_.is_late(problem.start, 0)});
    now_.swap(next_);
  }

  bool finished(Time time) const {
    const unsigned all = (1U << problem_.stops.size()) - 1;
    return std::ranges::any_of(now_, [&](const FreePlace& place) {
      if (place.counted != all || !place.late || !rules_.may_rest(place.cell, time)) return false;
      const Cell goal = problem_.destination ? *problem_.destination : problem_.stops[place.last];
      return place.cell == goal;
    });
  }

  // Advances to `time`. Returns false if the reachable states can no longer change.
  bool step(Time time) {
    next_.clear();
    for (const FreePlace& place : now_) {
      if (!barred(place.cell, time)) reach(place);
      for (Cell to : problem_.grid->neighbors(place.cell)) {
        if (barred(to, time) || rules_.move_barred(place.cell, to, place.mouth, time)) continue;
        FreePlace there = place;
        there.cell = to;
        there.mouth = rules_.mouth_after(place.cell, to, place.mouth);
        there.late = rules_.is_late(to, time);
        reach(there);
      }
    }
    now_.swap(next_);
    return time <= rules_.last_change() || now_ != next_;
  }

 private:
  bool may_follow(unsigned counted, int stop) const {
    const SequenceClass& work = problem_.work;
    const auto position = static_cast<std::size_t>(__builtin_popcount(counted));
    if ((counted >> stop & 1) != 0) return false;
    if (position < work.prefix.size()) return work.prefix[position] == stop;
    return position > work.prefix.size() || (work.forbidden_next >> stop & 1) == 0;
  }

  bool barred(Cell cell, Time time) const { return rules_.barred(cell, time); }

  void reach(FreePlace place) {
    next_.insert(place);
    for (int stop = 0; stop < static_cast<int>(problem_.stops.size()); ++stop) {
      if (problem_.stops[stop] != place.cell || !may_follow(place.counted, stop)) continue;
      FreePlace counting = place;
      counting.counted |= 1U << stop;
      counting.last = stop;
      next_.insert(counting);
    }
  }

  const FreeProblem& problem_;
  const StepRules rules_;
  std::set<FreePlace> now_;
  std::set<FreePlace> next_;
};

}  // namespace

Instance instance_of(const FreeProblem& problem) {
  InstanceBuilder builder(*problem.grid);
  std::optional<Position> goal;
  if (problem.destination) goal = problem.grid->position(*problem.destination);
  builder.add_agent("a", problem.grid->position(problem.start), goal);
  for (std::size_t k = 0; k < problem.stops.size(); ++k)
    builder.add_task(fmt::format("t{}", k), problem.grid->position(problem.stops[k]),
                     std::vector<std::string>{"a"});
  return std::move(builder).build();
}

std::optional<Time> free_reference_cost(const FreeProblem& problem) {
  FreeLayers layers(problem);
  for (Time t = 0;; ++t) {
    if (layers.finished(t)) return t;
    if (!layers.step(t + 1)) return std::nullopt;
  }
}

std::string path_error(const FreeProblem& problem, const Sequence& sequence, const Path& path) {
  Problem plain{problem.grid, problem.start, {}, problem.constraints};
  for (Stop stop : sequence) plain.goals.push_back(problem.stops[stop]);
  if (problem.destination) plain.goals.push_back(*problem.destination);
  return path_error(plain, path);
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

}  // namespace grove::detail::testing
