// SPDX-License-Identifier: MIT
#include "tests/oracle/group_oracle.h"

#include <algorithm>
#include <set>

#include "model/omega.h"
#include "tests/oracle/agent_states.h"
#include "tests/support/satisfies.h"

namespace grove::detail::oracle {
namespace {

constexpr std::size_t kExaminedPerWay = 40;

class PathEnumerator {
 public:
  PathEnumerator(const Instance& instance, AgentIndex agent,
                 std::span<const Constraint> constraints, Time most, std::size_t cap)
      : world_(instance.world()),
        states_(instance, agent),
        constraints_(constraints),
        most_(most),
        cap_(cap) {}

  std::optional<std::vector<PlacePath>> list() {
    extend(states_.start());
    if (examined_ > kExaminedPerWay * cap_ || ways_.size() > cap_) return std::nullopt;
    std::vector<PlacePath> paths(ways_.begin(), ways_.end());
    std::ranges::stable_sort(paths, {}, &PlacePath::size);
    return paths;
  }

 private:
  void extend(AgentStates::State state) {
    if (++examined_ > kExaminedPerWay * cap_ || ways_.size() > cap_) return;
    const auto time = static_cast<Time>(way_.size());
    if (states_.to_go(state) > most_ - time) return;
    way_.push_back(states_.cell(state));
    for (const AgentStates::Move& move : states_.moves(state)) {
      if (!states_.resting(move.to))
        extend(move.to);
      else if (satisfies())
        ways_.insert(way_);
    }
    way_.pop_back();
  }
  bool satisfies() const {
    Path path;
    for (const Place place : way_) path.push_back(some_state_on(place));
    return std::ranges::all_of(constraints_, [&](const Constraint& constraint) {
      return testing::satisfies(world_, path, constraint);
    });
  }
  State some_state_on(Place place) const {
    State some = kNoState;
    world_.for_each_state(place, [&](State state) { some = state; });
    return some;
  }

  const World& world_;
  const AgentStates states_;
  const std::span<const Constraint> constraints_;
  const Time most_;
  const std::size_t cap_;
  std::size_t examined_ = 0;
  PlacePath way_;
  std::set<PlacePath> ways_;
};

Place at(const PlacePath& way, std::size_t time) {
  return time < way.size() ? way[time] : way.back();
}

bool collide(const PlacePath& a, const PlacePath& b, bool may_follow) {
  for (std::size_t t = 0; t < std::max(a.size(), b.size()); ++t) {
    if (at(a, t) == at(b, t)) return true;
    if (t == 0) continue;
    const bool a_enters = at(a, t) == at(b, t - 1);
    const bool b_enters = at(b, t) == at(a, t - 1);
    if ((a_enters && b_enters) || (!may_follow && (a_enters || b_enters))) return true;
  }
  return false;
}

class CheapestCombination {
 public:
  CheapestCombination(const Instance& instance, std::span<const std::vector<PlacePath>> paths)
      : may_follow_(instance.may_follow()), ways_(paths) {}
  std::optional<Cost> least() {
    choose(0);
    return best_ < kInfiniteCost ? std::optional(best_) : std::nullopt;
  }

 private:
  void choose(Cost cost) {
    if (chosen_.size() == ways_.size()) {
      best_ = std::min(best_, cost);
      return;
    }
    for (const PlacePath& way : ways_[chosen_.size()]) {
      const Cost more = cost + static_cast<Cost>(way.size()) - 1;
      if (more + others_at_least() >= best_) return;  // later paths cost no less
      if (std::ranges::any_of(
              chosen_, [&](const PlacePath* other) { return collide(*other, way, may_follow_); }))
        continue;
      chosen_.push_back(&way);
      choose(more);
      chosen_.pop_back();
    }
  }
  Cost others_at_least() const {
    Cost sum = 0;
    for (std::size_t i = chosen_.size() + 1; i < ways_.size(); ++i)
      sum += ways_[i].empty() ? kInfiniteCost : static_cast<Cost>(ways_[i].front().size()) - 1;
    return sum;
  }

  const bool may_follow_;
  const std::span<const std::vector<PlacePath>> ways_;
  std::vector<const PlacePath*> chosen_;
  Cost best_ = kInfiniteCost;
};

}  // namespace

std::optional<std::vector<PlacePath>> paths_within(const Instance& instance, AgentIndex agent,
                                                   std::span<const Constraint> constraints,
                                                   Time most, std::size_t cap) try {
  return PathEnumerator(instance, agent, constraints, most, cap).list();
} catch (const AgentStates::TooMany&) {
  return std::nullopt;
}

std::optional<Cost> least_joint_cost(const Instance& instance,
                                     std::span<const std::vector<PlacePath>> paths) {
  return CheapestCombination(instance, paths).least();
}

}  // namespace grove::detail::oracle
