// SPDX-License-Identifier: MIT
#include "engine/choices_bounds.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <utility>

#include "assignment/assignment.h"
#include "engine/component.h"
#include "engine/single_assignment.h"

namespace grove::detail {
namespace {

// Effort per turn of the core-guided search, and per node of the tree (model/effort.h).
constexpr std::int64_t kAllEffort = 2'000'000;
constexpr std::int64_t kNodeEffort = 1'000'000;
// Scanned legs per turn of the tree (NgWalks::effort()).
constexpr std::int64_t kTreeEffort = 2'000'000;
constexpr std::size_t kTreeBytes = std::size_t{1} << 30;
constexpr double kLeafShare = 0.05;  // of the time that is left, per leaf
// Turns of the tree without a better bound before the other search gets turns.
constexpr int kIdleTurns = 10;
// The bound of the core-guided search has stalled if it has not risen for this share of the time of
// that search, and for at least one second.
constexpr double kStallShare = 0.3;
constexpr double kMinStall = 1;
// Scanned legs of the Lagrangian bound (about 1 s), and its share of the time at most.
constexpr std::int64_t kRoutesEffort = 150'000'000;
constexpr double kRoutesShare = 0.2;
constexpr Cost kMarginOffset = 100;  // after a failure the margin is at most (bound + this) / 2

}  // namespace

bool has_optional_tasks(const Instance& instance) {
  return std::ranges::any_of(instance.agents(), [](const Agent& a) { return !a.options.empty(); });
}

void improve_routes(RouteBound& routes, const SolveOptions& options, const Limits& limits) {
  routes.improve(kRoutesEffort, part_of(limits, options, kRoutesShare));
}

ChoicesBounds::ChoicesBounds(const Instance& instance, const SolveOptions& options,
                             const Limits& limits, MergedObserver& merged, RouteBound& route_bound,
                             ChoicesResult& result)
    : instance_(instance),
      options_(options),
      limits_(limits),
      merged_(merged),
      route_bound_(route_bound),
      result_(result),
      proves_leaves_(std::ranges::all_of(instance.agents(), &Agent::has_destination)),
      // Certificates do not contain the proof of the tree.
      is_tree_over_(options.proof || !has_optional_tasks(instance)) {}

bool ChoicesBounds::can_search_tree() const {
  return !is_tree_over_ && result_.plan() &&
         (comes_first() || tree_->lower_bound() >= result_.bound() || is_stalled());
}

// The tree comes first while its bound rises, until the other search has a better bound.
bool ChoicesBounds::comes_first() const {
  return idle_turns_ < kIdleTurns &&
         (spent_on_all_ == 0 || !tree_ || tree_->lower_bound() >= result_.bound());
}

bool ChoicesBounds::is_stalled() const {
  return !can_search_all() || since_rise_ > std::max(kMinStall, kStallShare * spent_on_all_);
}

bool ChoicesBounds::is_turn_of_tree() const {
  return can_search_tree() &&
         (comes_first() || !can_search_all() || spent_on_tree_ <= spent_on_all_);
}

void ChoicesBounds::improve() {
  const bool is_tree = is_turn_of_tree();
  const auto start = limits_.now();
  const Cost before = result_.bound();
  try {
    is_tree ? search_tree() : search_all();
  } catch (const std::bad_alloc&) {
    limits_.memory_exhausted();
    is_tree_over_ = true;  // the node that was expanded is lost
    tree_.reset();
  }
  const double seconds = turn_seconds(options_, limits_, start);
  (is_tree ? spent_on_tree_ : spent_on_all_) += seconds;
  if (!is_tree) since_rise_ = result_.bound() > before ? 0 : since_rise_ + seconds;
}

void ChoicesBounds::search_tree() {
  if (!tree_)
    tree_ = std::make_unique<AssignmentTree>(instance_, route_bound_,
                                             at_most_a_quarter(kTreeBytes, limits_));
  const Cost before = tree_->lower_bound();
  const bool offer_nodes = idle_turns_ >= kIdleTurns && is_stalled();
  const auto outcome = tree_->run(result_.cost(), kTreeEffort, offer_nodes, limits_);
  if (outcome == AssignmentTree::Outcome::kNode) search_node();
  is_tree_over_ =
      outcome == AssignmentTree::Outcome::kClosed || outcome == AssignmentTree::Outcome::kStuck;
  if (!offer_nodes) idle_turns_ = tree_->lower_bound() > before ? 0 : idle_turns_ + 1;
  result_.raise_bound(tree_->lower_bound(), ComponentId::kLagrangian);
}

void ChoicesBounds::search_node() {
  Cost proven = 0;
  if (const std::optional<Assignment> leaf = tree_->leaf()) {
    proven = result_.search(*leaf, kLeafShare);
    if (!proves_leaves_) proven = 0;
  } else {
    proven = result_.search(tree_->node(), kNodeEffort);
  }
  tree_->resolve(proven);
}

// Searches all assignments for a while, first for plans below the incumbent. If there are too many
// choices, it lowers the cutoff to the bound plus `cutoff_margin_`, and improves the multipliers,
// so that reduced cost fixing leaves fewer choices. If no plan is below this cutoff, the bound
// rises to the cutoff, and the search starts again.
void ChoicesBounds::search_all() {
  if (!all_) {
    if (!std::exchange(has_announced_all_, true))
      merged_.note(
          "Core-guided search over all assignments, alternating with searches of single ones.");
    const Cost bound = result_.bound();
    cutoff_ = cutoff_margin_ < result_.cost() - bound ? bound + cutoff_margin_ : result_.cost();
    all_ = AllAssignmentsSearch::make(instance_, route_bound_, cutoff_, options_, limits_);
    result_.set_running(all_.get());
  }
  cutoff_ = std::min(cutoff_, result_.cost());
  const bool is_open = all_ && all_->run(cutoff_, kAllEffort, [this] { use_result_of_all(); });
  if (all_) use_result_of_all();
  if (is_open || limits_.stop_requested()) return;
  if (all_) end_all();
  if (result_.reported() >= cutoff_) return;
  const Cost bound = result_.bound();
  cutoff_margin_ = std::min({cutoff_margin_, cutoff_ - bound, bound + kMarginOffset}) / 2;
  if (!route_bound_.can_improve()) return;
  improve_routes(route_bound_, options_, limits_);
  result_.raise_bound(route_bound_.lower_bound(), ComponentId::kLagrangian);
  cutoff_margin_ = std::max<Cost>(cutoff_margin_, 1);
}

void ChoicesBounds::use_result_of_all() {
  const Cost proven = std::min(all_->lower_bound(), cutoff_);
  if (proven >= kInfiniteCost) {
    cutoff_margin_ = 0;
    return result_.prove_infeasible();
  }
  const std::optional<Plan>& plan = all_->plan();
  if (plan && plan->cost < result_.cost())
    result_.use_plan_and_bound(*plan, PlanSource::kCores, proven, ComponentId::kCores);
  else if (proven <= result_.reported())
    result_.report_progress();
  else
    result_.raise_bound(proven, ComponentId::kCores, true);
}

void ChoicesBounds::end_all() {
  result_.add_counts_of(*all_);
  result_.set_running(nullptr);
  all_.reset();
}

}  // namespace grove::detail
