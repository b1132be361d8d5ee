// SPDX-License-Identifier: MIT
#include "tests/fuzz/claims.h"

#include <fmt/format.h>

#include <utility>

#include "model/check.h"

namespace grove::detail::fuzz {
namespace {

class Claims {
 public:
  Claims(const Instance& instance, const oracle::Answer& truth, Omega omega,
         const Solution& solution, bool stopped)
      : instance_(instance), truth_(truth), omega_(omega), solution_(solution), stopped_(stopped) {}

  std::vector<std::string> examine() {
    examine_consistency();
    if (solution_.plan) examine_plan();
    if (truth_.plan)
      examine_against(truth_.plan->cost);
    else
      examine_against_no_plan();
    examine_effort();
    return std::move(complaints_);
  }

 private:
  template <typename... Args>
  void expect(bool holds, fmt::format_string<Args...> complaint, Args&&... args) {
    if (!holds) complaints_.push_back(fmt::format(complaint, std::forward<Args>(args)...));
  }

  bool claims_plan() const {
    return solution_.status == Status::kOptimal || solution_.status == Status::kBounded ||
           solution_.status == Status::kFeasible;
  }

  void examine_consistency() {
    const std::string_view status = to_string(solution_.status);
    expect(solution_.omega == omega_, "reports omega {}", solution_.omega.to_string());
    expect(solution_.lower_bound >= 0, "lower bound {} is negative", solution_.lower_bound);
    expect(claims_plan() == solution_.plan.has_value(), "status {} {} a plan", status,
           solution_.plan ? "with" : "without");
    if (!solution_.plan) return;
    const Status due = status_of(solution_.plan->cost, solution_.lower_bound, omega_);
    expect(solution_.status == due, "status {} where cost {} and bound {} make it {}", status,
           solution_.plan->cost, solution_.lower_bound, to_string(due));
  }

  void examine_plan() {
    for (const Violation& violation : check(instance_, solution_))
      expect(false, "the plan is invalid: {}: {}", violation.json_pointer, violation.message);
  }

  void examine_against(Cost optimum) {
    expect(solution_.status != Status::kInfeasible, "infeasible, but a plan of cost {} exists",
           optimum);
    expect(solution_.lower_bound <= optimum, "lower bound {} exceeds the optimum {}",
           solution_.lower_bound, optimum);
    if (!solution_.plan) return;
    const Cost cost = solution_.plan->cost;
    expect(cost >= optimum, "cost {} is below the optimum {}", cost, optimum);
    if (solution_.status == Status::kOptimal)
      expect(cost == optimum, "optimal with cost {}, but the optimum is {}", cost, optimum);
    if (solution_.status == Status::kBounded)
      expect(omega_.accepts(cost, optimum), "bounded with cost {}, too much for the optimum {}",
             cost, optimum);
  }

  void examine_against_no_plan() {
    expect(!solution_.plan, "a plan, but there is none");
    expect(solution_.status == Status::kInfeasible || solution_.status == Status::kUnknown,
           "status {}, but there is no plan", to_string(solution_.status));
  }

  // A run must reach the requested tolerance unless it was stopped by a limit or omega = inf, or
  // does not search all assignments.
  void examine_effort() {
    if (stopped_ || omega_.is_infinite() || instance_.has_choices()) return;
    expect(solution_.status != Status::kUnknown && solution_.status != Status::kFeasible,
           "status {} although no limit was reached", to_string(solution_.status));
  }

  const Instance& instance_;
  const oracle::Answer& truth_;
  Omega omega_;
  const Solution& solution_;
  bool stopped_;
  std::vector<std::string> complaints_;
};

}  // namespace

std::vector<std::string> false_claims(const Instance& instance, const oracle::Answer& truth,
                                      Omega omega, const Solution& solution, bool stopped) {
  return Claims(instance, truth, omega, solution, stopped).examine();
}

}  // namespace grove::detail::fuzz
