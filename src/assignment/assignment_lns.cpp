// SPDX-License-Identifier: MIT
// Iterations of string removals (string_removal.h). Routes that cost more are accepted with a
// probability that falls with their cost and with the effort (simulated annealing). For variants,
// all routes below a limit are accepted.
#include "assignment/assignment_lns.h"

#include <cmath>
#include <optional>
#include <utility>

#include "assignment/string_removal.h"
#include "model/random.h"

namespace grove::detail {
namespace {

constexpr double kFirstTemperature = 3;  // steps
constexpr double kLastTemperature = 0.1;
constexpr std::int64_t kIterationsPerPoll = 64;

class AssignmentLns {
 public:
  // `cost_limit`: routes of less than this total cost are accepted; nullopt: simulated annealing
  // with an effort of `insertions`.
  AssignmentLns(Routes& routes, std::optional<Cost> cost_limit, std::int64_t insertions,
                std::uint64_t seed)
      : routes_(routes),
        best_(routes),
        random_(seed),
        strings_(routes, random_, {}),
        cost_limit_(cost_limit),
        insertions_(insertions),
        cost_(routes.cost()),
        best_cost_(cost_) {}

  bool is_over() const { return !strings_.is_possible() || tried() >= insertions_; }

  void iterate() {
    ++iterations_;
    const std::optional<Cost> change = strings_.apply();
    if (!change) return;
    if (!is_accepted(cost_ + *change)) return strings_.undo();
    cost_ += *change;
    if (cost_limit_ || cost_ >= best_cost_) return;
    best_cost_ = cost_;
    best_ = routes_;
  }

  // Ends the search with the best routes. For variants: with the current ones.
  void finish() {
    if (!cost_limit_) routes_ = std::move(best_);
  }

 private:
  // Insertions into a route, and one per iteration.
  std::int64_t tried() const { return strings_.insertions() + iterations_; }

  bool is_accepted(Cost cost) {
    if (cost_limit_) return cost < *cost_limit_;
    if (cost <= cost_) return true;
    const double done = static_cast<double>(tried()) / static_cast<double>(insertions_);
    const double temperature =
        kFirstTemperature * std::pow(kLastTemperature / kFirstTemperature, done);
    const double random = (1 + random_.below(1 << 20)) / static_cast<double>(1 << 20);
    return static_cast<double>(cost - cost_) < -temperature * std::log(random);
  }

  Routes& routes_;
  Routes best_;
  Random random_;
  StringRemoval strings_;
  const std::optional<Cost> cost_limit_;
  const std::int64_t insertions_;
  Cost cost_;  // of the routes
  Cost best_cost_;
  std::int64_t iterations_ = 0;
};

void run(AssignmentLns&& search, const Limits& limits) {
  for (std::int64_t i = 0; !search.is_over(); ++i) {
    if (i % kIterationsPerPoll == 0 && limits.stop_requested()) break;
    search.iterate();
  }
  search.finish();
}

}  // namespace

void improve_routes(Routes& routes, std::int64_t insertions, std::uint64_t seed,
                    const Limits& limits) {
  run(AssignmentLns(routes, std::nullopt, insertions, seed), limits);
}

void vary_routes(Routes& routes, Cost cost_limit, std::int64_t insertions, std::uint64_t seed,
                 const Limits& limits) {
  run(AssignmentLns(routes, cost_limit, insertions, seed), limits);
}

}  // namespace grove::detail
