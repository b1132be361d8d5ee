// SPDX-License-Identifier: MIT
// Subgradient ascent. The bound for given multipliers is that of route_relaxation.h; lower_bound()
// rounds it up, because costs are integral. Integral multipliers are found by local search.
#include "assignment/route_bound.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "assignment/agent_walks.h"
#include "assignment/goal_choice.h"
#include "assignment/route_relaxation.h"
#include "model/assert.h"
#include "model/random.h"
#include "sequencing/ng_walks.h"

namespace grove::detail {
namespace {

constexpr double kFirstFactor = 0.5;         // of the step size by Polyak
constexpr double kFactorAfterChoices = 0.1;  // the same after choices are fixed or decided
constexpr double kLastFactor = 0.005;
constexpr double kRetreatFactor = 0.9;  // of the factor, after multipliers without a bound
constexpr int kRoundings = 60;          // sets of integral multipliers that are tried
constexpr int kPatience = 6;            // iterations without progress before the factor is halved

}  // namespace

class RouteBound::Ascent {
 public:
  explicit Ascent(const Routes& routes)
      : relaxation_(routes.costs()), instance_(routes.costs().instance()), target_(routes.cost()) {
    if (!relaxation_.is_too_large()) start_with(routes);
  }

  RouteRelaxation& relaxation() { return relaxation_; }
  const RouteRelaxation& relaxation() const { return relaxation_; }

  void improve(std::int64_t max_effort, const Limits& limits) {
    const std::int64_t end = effort() + max_effort;
    while (effort() < end && can_improve()) {
      const std::int64_t before = effort();
      switch (relaxation_.evaluate(now_, end - effort(), limits)) {
        case NgWalks::Outcome::kStopped:
          return;
        case NgWalks::Outcome::kNegativeCycle:
          if (relaxation_.has_grown()) continue;
          retreat();
          factor_ *= kRetreatFactor;
          continue;
        case NgWalks::Outcome::kFound:
          break;
      }
      evaluation_effort_ = effort() - before;
      if (!best_ || relaxation_.bound() > best_->bound) {
        best_ = {relaxation_.bound(), now_};
        failures_ = 0;
        if (lower_bound() >= target_) return;
      } else if (++failures_ == kPatience) {
        failures_ = 0;
        factor_ /= 2;
      }
      if (!step()) factor_ = 0;
    }
  }

  bool can_improve() const {
    return !relaxation_.is_too_large() && (!best_ || lower_bound() < target_) &&
           factor_ > kLastFactor;
  }

  std::int64_t evaluation_effort() const { return evaluation_effort_; }
  std::int64_t fine_bound() const { return best_ ? std::max<std::int64_t>(0, best_->bound) : 0; }
  Cost lower_bound() const { return (fine_bound() + kUnit - 1) / kUnit; }

  std::optional<std::vector<Choices>> choices_below(Cost cutoff, const Limits& limits) {
    if (!best_) return std::nullopt;
    return relaxation_.choices_below(best_->multipliers, cutoff, limits);
  }

  bool fix(Cost cutoff, const Limits& limits) {
    if (!best_ || !relaxation_.fix(best_->multipliers, cutoff, limits)) return false;
    if (cutoff < kInfiniteCost) target_ = cutoff;
    use_new_conditions();
    return true;
  }

  // After choices are fixed or decided: continues from the best multipliers.
  void use_new_conditions() {
    std::vector<std::int64_t>& on_visits = best_->multipliers.on_visits;
    for (std::size_t i = on_visits.size(); i < relaxation_.needs().size(); ++i)
      on_visits.push_back(on_visits[relaxation_.tasks_of_conditions()[i]]);
    now_ = best_->multipliers;
    factor_ = kFactorAfterChoices;
    failures_ = 0;
  }

  // Local search from the rounded multipliers: each multiplier whose condition is not met with
  // equality changes by 1 with probability 1/4.
  std::optional<Multipliers> rounded(std::int64_t max_effort, const Limits& limits) {
    if (!best_) return std::nullopt;
    const std::int64_t end = effort() + max_effort;
    now_ = best_->multipliers;
    for (std::int64_t& multiplier : now_.on_visits)
      multiplier = (multiplier + kUnit / 2) / kUnit * kUnit;
    for (std::int64_t& multiplier : now_.on_goals)
      multiplier = (multiplier + kUnit / 2) / kUnit * kUnit;
    std::optional<Best> best;
    Random random(0);
    for (int round = 0; round < kRoundings && effort() < end; ++round) {
      if (!evaluate_integral(end, limits)) break;
      if (!best || relaxation_.bound() >= best->bound) {
        best = {relaxation_.bound(), now_};
      } else {
        now_ = best->multipliers;
        if (!evaluate_integral(end, limits)) break;
      }
      const auto vary = [&](std::int64_t& multiplier, std::int64_t direction) {
        if (direction == 0 || random.below(4) > 0) return;
        multiplier = std::max<std::int64_t>(0, multiplier + (direction > 0 ? kUnit : -kUnit));
      };
      for_each_direction(vary);
    }
    if (!best || limits.stop_requested()) return std::nullopt;
    Multipliers result;
    for (TaskIndex task = 0; task < instance_.task_count(); ++task)
      result.on_visits.push_back(static_cast<Time>(best->multipliers.on_visits[task] / kUnit));
    for (std::size_t i = 0; i < relaxation_.places().size(); ++i)
      result.on_goals.emplace_back(relaxation_.places()[i],
                                   static_cast<Time>(best->multipliers.on_goals[i] / kUnit));
    return result;
  }

 private:
  static constexpr std::int64_t kUnit = AgentWalks::kUnit;
  struct Best {
    std::int64_t bound = 0;
    RouteMultipliers multipliers;
  };

  std::int64_t effort() const { return relaxation_.effort(); }

  // The first multipliers: for a visit, the least saving of a route without it; for a goal, the
  // dual price of an optimal assignment of the agents to goals.
  void start_with(const Routes& routes) {
    now_.on_visits.assign(relaxation_.needs().size(), 0);
    std::vector<bool> is_set(relaxation_.needs().size(), false);
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      for (const TaskIndex task : routes.stops(agent)) {
        const auto condition = relaxation_.condition(agent, task);
        if (!condition) continue;
        Routes without = routes;
        const std::int64_t saved = std::max<Cost>(0, without.remove(agent, task)) * kUnit;
        std::int64_t& multiplier = now_.on_visits[*condition];
        multiplier = is_set[*condition] ? std::min(multiplier, saved) : saved;
        is_set[*condition] = true;
      }
    now_.on_goals.assign(relaxation_.places().size(), 0);
    const auto choice = cheapest_goals(instance_, [&](AgentIndex agent, Place goal) {
      return Cost{routes.leg_to_goal(agent, goal)};
    });
    if (!choice) return;
    for (std::size_t i = 0; i < now_.on_goals.size(); ++i)
      now_.on_goals[i] = std::min<Cost>(choice->prices[i], kNever) * kUnit;
  }

  // Evaluates integral multipliers. While a cycle has a negative cost, lowers the greatest
  // multiplier of its visits. Returns false after about `end` labels in total, or at a limit.
  bool evaluate_integral(std::int64_t end, const Limits& limits) {
    for (;;) {
      const auto outcome =
          relaxation_.evaluate(now_, std::max<std::int64_t>(end - effort(), 1), limits);
      if (outcome != NgWalks::Outcome::kNegativeCycle) return outcome == NgWalks::Outcome::kFound;
      if (relaxation_.has_grown()) continue;
      std::int64_t* greatest = nullptr;
      for (const std::size_t condition : relaxation_.conditions_of_cycle()) {
        std::int64_t& multiplier = now_.on_visits[condition];
        if (greatest == nullptr || multiplier > *greatest) greatest = &multiplier;
      }
      GROVE_CHECK(greatest != nullptr && *greatest >= kUnit, "a negative cycle has a multiplier");
      *greatest -= kUnit;
    }
  }

  // Calls use(multiplier, its component of the subgradient) for each multiplier.
  template <class Use>
  void for_each_direction(Use use) {
    for (std::size_t i = 0; i < now_.on_visits.size(); ++i)
      use(now_.on_visits[i], relaxation_.needs()[i] - relaxation_.visits()[i]);
    for (std::size_t i = 0; i < now_.on_goals.size(); ++i)
      use(now_.on_goals[i], relaxation_.uses()[i] - 1);
  }

  // Changes the multipliers along the subgradient, with the step size by Polyak. Returns false if
  // the subgradient is 0.
  bool step() {
    std::int64_t norm = 0;
    for_each_direction(
        [&](std::int64_t, std::int64_t direction) { norm += direction * direction; });
    if (norm == 0) return false;
    const double length = factor_ * static_cast<double>(target_ * kUnit - relaxation_.bound()) /
                          static_cast<double>(norm);
    for_each_direction([&](std::int64_t& multiplier, std::int64_t direction) {
      multiplier += static_cast<std::int64_t>(length * static_cast<double>(direction));
      multiplier = std::max<std::int64_t>(multiplier, 0);
    });
    return true;
  }

  // The multipliers give no bound: moves them towards the best ones, or towards 0.
  void retreat() {
    for (std::size_t i = 0; i < now_.on_visits.size(); ++i)
      now_.on_visits[i] = best_ ? (now_.on_visits[i] + best_->multipliers.on_visits[i]) / 2
                                : now_.on_visits[i] * 7 / 8;
    for (std::size_t i = 0; best_ && i < now_.on_goals.size(); ++i)
      now_.on_goals[i] = (now_.on_goals[i] + best_->multipliers.on_goals[i]) / 2;
  }

  RouteRelaxation relaxation_;
  const Instance& instance_;
  Cost target_;  // of the ascent: the cost of routes, or a cutoff
  RouteMultipliers now_;
  std::optional<Best> best_;
  double factor_ = kFirstFactor;
  int failures_ = 0;  // iterations since the last progress
  std::int64_t evaluation_effort_ = 0;
};

RouteBound::RouteBound(const Routes& routes) : ascent_(std::make_unique<Ascent>(routes)) {}
RouteBound::RouteBound(const RouteBound& other)
    : ascent_(std::make_unique<Ascent>(*other.ascent_)) {}
RouteBound::~RouteBound() = default;

void RouteBound::improve(std::int64_t max_effort, const Limits& limits) {
  ascent_->improve(max_effort, limits);
}

bool RouteBound::can_improve() const {
  return ascent_->can_improve();
}

Cost RouteBound::lower_bound() const {
  return ascent_->lower_bound();
}

std::int64_t RouteBound::fine_bound() const {
  return ascent_->fine_bound();
}

std::optional<std::vector<RouteBound::Choices>> RouteBound::choices_below(Cost cutoff,
                                                                          const Limits& limits) {
  return ascent_->choices_below(cutoff, limits);
}

bool RouteBound::fix(Cost cutoff, const Limits& limits) {
  return ascent_->fix(cutoff, limits);
}

void RouteBound::restrict_to(const std::vector<Choices>& choices) {
  ascent_->relaxation().restrict_to(choices);
  ascent_->use_new_conditions();
}

const std::vector<RouteBound::Choices>& RouteBound::choices() const {
  return ascent_->relaxation().choices();
}

bool RouteBound::is_feasible() const {
  return ascent_->relaxation().is_feasible();
}

double RouteBound::share(AgentIndex agent, TaskIndex task) const {
  return ascent_->relaxation().share(agent, task);
}

double RouteBound::share_of_goal(AgentIndex agent, Place goal) const {
  return ascent_->relaxation().share_of_goal(agent, goal);
}

std::optional<RouteBound::Multipliers> RouteBound::rounded(std::int64_t max_effort,
                                                           const Limits& limits) {
  return ascent_->rounded(max_effort, limits);
}

std::vector<TaskIndex> RouteBound::neighborhood(AgentIndex agent, TaskIndex task) const {
  return ascent_->relaxation().neighborhood(agent, task);
}

std::size_t RouteBound::bytes() const {
  return ascent_->relaxation().bytes();
}

std::int64_t RouteBound::evaluation_effort() const {
  return ascent_->evaluation_effort();
}

std::int64_t RouteBound::effort() const {
  return ascent_->relaxation().effort();
}

}  // namespace grove::detail
