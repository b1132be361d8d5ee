// SPDX-License-Identifier: MIT
#include "engine/all_assignments.h"

#ifdef GROVE_WITH_CADICAL
#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

#include "assignment/priced_instance.h"
#include "cores/core_search.h"
#include "engine/component.h"
#include "model/check.h"
#include "planning/agent_stops_cache.h"
#include "planning/problem.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{4} << 30;

// The result if it is known in advance that no plan costs less than the cutoff.
class NoPlan : public AllAssignmentsSearch {
 public:
  explicit NoPlan(Cost cutoff) : cutoff_(cutoff) {}
  bool run(Cost, std::int64_t, const std::function<void()>&) override { return false; }
  Cost lower_bound() const override { return cutoff_; }
  const std::optional<Plan>& plan() const override { return no_plan_; }
  void add_counts(Counters&) const override {}

 private:
  const Cost cutoff_;
  const std::optional<Plan> no_plan_;
};

class AllAssignmentsCores : public AllAssignmentsSearch {
 public:
  AllAssignmentsCores(const Instance& instance, PricedInstance priced, const SolveOptions& options,
                      const Limits& limits)
      : limits_(limits),
        proof_(options.proof),
        priced_(std::move(priced)),
        problem_(priced_.instance, limits, options.threads),
        stops_(priced_.instance, problem_.distances, &priced_.prices) {
    if (!problem_.distances.complete()) return;
    const auto make_plan = [this, &instance](const std::vector<CountedPath>& paths) {
      return checked_plan(instance, plan_of(instance, priced_, paths));
    };
    search_ = std::make_unique<CoreSearch>(
        problem_, stops_, techniques_of(options), at_most_a_quarter(kMaxBytes, limits), limits,
        options.proof, 0, PricedChoices{&priced_.prices, make_plan});
  }

  bool run(Cost cutoff, std::int64_t effort, const std::function<void()>& after_step) override {
    const bool is_open = search_ && advance(cutoff, effort, after_step);
    log_bound(cutoff);
    return is_open;
  }
  Cost lower_bound() const override {
    return search_ && search_->is_set_up() ? search_->lower_bound() : 0;
  }
  const std::optional<Plan>& plan() const override { return search_ ? search_->plan() : no_plan_; }
  void add_counts(Counters& counters) const override {
    if (!search_) return;
    counters[Counter::kCores] += search_->cores();
    counters[Counter::kCoresConflicts] += search_->sat_conflicts();
    counters[Counter::kCoresPathConflicts] += search_->path_conflicts();
  }

 private:
  // Returns false if the search is over.
  bool advance(Cost cutoff, std::int64_t effort, const std::function<void()>& after_step) {
    const std::int64_t end = search_->work() + effort;
    while (search_->work() < end && !limits_.stop_requested()) {
      if (search_->step(cutoff) != CoreSearch::Outcome::kWorking) return false;
      if (after_step) after_step();
    }
    return true;
  }

  // A bound of kInfiniteCost: there is no plan.
  void log_bound(Cost cutoff) {
    const Cost proven = std::min(lower_bound(), cutoff);
    if (proof_ == nullptr || proven <= logged_) return;
    logged_ = proven;
    proof_->formula_bound(proven);
  }

  const Limits& limits_;
  ProofLog* const proof_;
  Cost logged_ = 0;
  const PricedInstance priced_;
  const Problem problem_;
  const AgentStopsCache stops_;
  const std::optional<Plan> no_plan_;
  std::unique_ptr<CoreSearch> search_;  // nullptr: a limit was reached before it began
};

}  // namespace

bool AllAssignmentsSearch::is_available(const SolveOptions& options) {
  return techniques_of(options).has(Technique::kCores);
}

std::unique_ptr<AllAssignmentsSearch> AllAssignmentsSearch::make(const Instance& instance,
                                                                 RouteBound& bound, Cost cutoff,
                                                                 const SolveOptions& options,
                                                                 const Limits& limits) {
  if (!is_available(options)) return nullptr;
  std::optional<PricedInstance> priced;
  const Fixing fixing = options.proof ? Fixing::kNone : Fixing::kByReducedCosts;
  switch (price_choices(instance, bound, cutoff, fixing, limits, priced)) {
    case Pricing::kNotPossible:
      return nullptr;
    case Pricing::kNoPlan:
      if (options.proof) return nullptr;  // certificates do not contain this reasoning
      return std::make_unique<NoPlan>(cutoff);
    case Pricing::kDone:
      break;
  }
  return std::make_unique<AllAssignmentsCores>(instance, *std::move(priced), options, limits);
}

}  // namespace grove::detail
#else
namespace grove::detail {

bool AllAssignmentsSearch::is_available(const SolveOptions&) {
  return false;
}

std::unique_ptr<AllAssignmentsSearch> AllAssignmentsSearch::make(const Instance&, RouteBound&, Cost,
                                                                 const SolveOptions&,
                                                                 const Limits&) {
  return nullptr;
}

}  // namespace grove::detail
#endif
