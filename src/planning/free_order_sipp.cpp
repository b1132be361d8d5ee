// SPDX-License-Identifier: MIT
// Low level of CBS over all sequences of a class at once. It runs one safe-interval search
// (safe_interval_search.h, free_order_goals.h) with a cap on f. If the result is not conclusive, it
// widens the costs to go and searches again.
//
// *Exactness with a bounded graph.* The costs to go cover every sequence of cost less than
// outside_bound(). The search drops labels in stages that the costs to go do not cover, and labels
// of f > outside_bound(). *Claim: no path that costs less than outside_bound() is lost.* *Proof.*
// Let P be such a path that realizes a sequence of the class. If P counts each stop as early as
// possible, it realizes a sequence s of the class, too. P visits the stops of s in this order, so s
// costs at most cost(P) < outside_bound(). Hence all stages of s are covered with their exact costs
// to go, which are at most the remaining cost of P. Therefore every label along P has t + h <=
// cost(P). Instead of P's label the search can hold an earlier one of the same state, interval and
// stage. The path to that label, a wait, and the remainder of P form a path of the class that costs
// at most as much as P, and the argument holds for this path. Sequences that the graph does not
// cover play no part in the argument. It also holds with deadlines and with the dominance rule
// (free_order_goals.h, stop_dominance.cpp), because P can continue from the label that is kept.
//
// *Consequence.* If the search finds a path that costs at most outside_bound(), this path is
// optimal, because the search loses no cheaper path. If it finds none, every path costs at least
// outside_bound(). If the cutoff is below outside_bound(), the outcome is then kAboveCutoff;
// otherwise the graph is extended and the search restarts. If no label was dropped for its f or its
// stage, the search was exhaustive, and the outcome is kInfeasible for any graph.
//
// *Graphs by direct legs* (sequence_dag.cpp) represent paths instead of sequences. Such a graph
// covers all stages of each path of the class that costs less than outside_bound() and counts stops
// as early as possible, and its costs to go are at most the remaining cost of the path. Therefore
// every label along P has t + h <= cost(P) there as well, and the rest of the argument is the same.
//
// *Early termination.* No path costs less than the first rest, so a path of exactly that cost is
// optimal, no matter which sequence it realizes. If the first rest is later than outside_bound(),
// labels are kept up to the first rest.
//
// *Late costs.* If places are barred forever, the plain costs to go ignore the detour around them,
// and a search that uses them can try all orders. So at most once per call, after many expansions
// or before the costs to go are widened, the costs of the legs are recomputed (late_costs.cpp). If
// the best sequence costs more with the new legs, the search restarts with separate costs to go
// over the new legs. All of the above holds for the late costs in place of the plain ones, because
// a path through the stops of s costs at least as much as s, and from any of its stages on at least
// the cost to go.
//
// *Cutoff.* Labels of f > cutoff are dropped. Therefore kAboveCutoff proves only that no path costs
// the cutoff or less. A constraint that the agent comes to rest by t (kRestBy) acts as a cutoff of
// t plus the longest time that the agent needs for turns and task executions after its last
// arrival. If no path is within this cutoff, the outcome is kInfeasible: for each path that comes
// to rest in time there is one that is equal until then and finishes without waiting.
//
// *Known sequences.* A primal heuristic that accepts any good path can restrict the search to the
// sequences that the costs to go cover. The cap is then the cutoff itself. If the search finds no
// path, this proves nothing unless the costs to go cover all sequences.
//
// *Feasibility check.* An infeasible call can visit all 2^n sets of stops, because with time
// windows the decision problem is NP-hard. The same holds for calls in which the least cost is far
// above the cutoff. Most such calls are due to a door that is closed before or behind the agent. So
// at most once per call single_stop_bound.cpp computes a lower bound on the cost from each stop
// separately.
//
// *Measured* on the benchmark's 32x32 maps with obstacles (nine other agents, one core, median of a
// call in microseconds):
//
//                                          n = 5   n = 10   n = 20
// no constraints                               6       14       24
// 20 constraints on the paths found           17       35       57
// 60 constraints on the paths found           34       64      138
// fixed sequence, no constraints               5        8       15
// fixed sequence, 20 constraints              12       14       22
// fixed sequence, 60 constraints              21       24       31
#include "planning/free_order_sipp.h"

#include <algorithm>
#include <optional>

#include "model/assert.h"
#include "planning/free_order_goals.h"
#include "planning/late_costs.h"
#include "planning/safe_interval_search.h"
#include "planning/single_stop_bound.h"

namespace grove::detail {
namespace {

// Number of expansions in one call after which the feasibility check pays off. The check also runs
// before costs to go that cover some sequence of the class are extended.
constexpr std::int64_t kExpansionsBeforeCheck = 1 << 12;
// After this many expansions in one call, if not earlier, the costs of the legs are recomputed.
// Both the expansions and the recomputation take some milliseconds.
constexpr std::int64_t kExpansionsBeforeRecomputation = 1 << 13;

constexpr std::int64_t kNotAgain = PathQuery::kUnlimited;

}  // namespace

class FreeOrderSipp::Workspace {
 public:
  explicit Workspace(const World& world)
      : search_(world),
        visit_check_(world, search_.intervals()),
        late_stages_(world, search_.intervals()) {}

  PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits, Path& path);
  std::int64_t expanded() const { return search_.expanded(); }

 private:
  using Search = SafeIntervalSearch<FreeOrderGoals>;

  void set_thresholds(const PathQuery& query);
  PathOutcome find_any();
  PathOutcome find_known();
  std::optional<PathOutcome> find_within(Time cap);
  std::optional<PathOutcome> check_feasibility();
  bool recompute_costs();
  SequenceStages& goals() { return search_.goals().stages(); }

  Search search_;
  SingleStopBound visit_check_;
  LateStages late_stages_;

  // Data of the current call.
  const ConflictAvoidanceTable* others_ = nullptr;
  const Limits* limits_ = nullptr;
  Path* path_ = nullptr;
  Time latest_ = 0;                                // greatest cost of a useful path
  PathOutcome above_ = PathOutcome::kAboveCutoff;  // outcome if every path costs more than latest_
  // Values of expanded() at which find_within() aborts, calls check_feasibility(), and calls
  // recompute_costs().
  std::int64_t abort_at_ = 0;
  std::int64_t check_feasibility_at_ = 0;
  std::int64_t recompute_costs_at_ = 0;
};

FreeOrderSipp::FreeOrderSipp(const World& world) : workspace_(std::make_unique<Workspace>(world)) {}
FreeOrderSipp::~FreeOrderSipp() = default;

PathOutcome FreeOrderSipp::find(SequenceStages& goals, const PathQuery& query, const Limits& limits,
                                Path& path) {
  return workspace_->find(goals, query, limits, path);
}

std::int64_t FreeOrderSipp::expanded() const {
  return workspace_->expanded();
}

PathOutcome FreeOrderSipp::Workspace::find(SequenceStages& goals, const PathQuery& query,
                                           const Limits& limits, Path& path) {
  SafeIntervals& intervals = search_.intervals();
  if (query.reservations)
    intervals.assign(*query.reservations);
  else
    intervals.assign(query.constraints);
  if (limits.stop_requested()) return PathOutcome::kStopped;
  others_ = query.others;
  limits_ = &limits;
  path_ = &path;
  if (!search_.goals().assign(goals, intervals, query.inflation_percent))
    return PathOutcome::kInfeasible;
  Time rest_by = intervals.latest_rest();
  if (rest_by < kNever) rest_by += goals.stops().longest_finish(intervals.only_rest());
  latest_ = std::min(query.cutoff, rest_by);
  const bool must_rest = rest_by < kNever && rest_by <= query.cutoff;
  above_ = must_rest ? PathOutcome::kInfeasible : PathOutcome::kAboveCutoff;
  if (search_.goals().first_rest() > latest_) return above_;
  if (intervals.start_slot(goals.stops().start()) < 0) return PathOutcome::kInfeasible;
  set_thresholds(query);
  return query.known_sequences_only && goals.cost_to_go().outside_bound() <= query.cutoff
             ? find_known()
             : find_any();
}

void FreeOrderSipp::Workspace::set_thresholds(const PathQuery& query) {
  // With reservations and a label limit the caller does not need a proof of infeasibility.
  const bool may_check_feasibility =
      !query.reservations || query.label_limit == PathQuery::kUnlimited;
  abort_at_ = search_.expanded_after(query.label_limit);
  check_feasibility_at_ =
      may_check_feasibility ? search_.expanded_after(kExpansionsBeforeCheck) : kNotAgain;
  recompute_costs_at_ = search_.expanded_after(kExpansionsBeforeRecomputation);
}

PathOutcome FreeOrderSipp::Workspace::find_known() {
  recompute_costs_at_ = kNotAgain;
  const PathOutcome outcome = *find_within(latest_);
  if (outcome == PathOutcome::kFound) return outcome;
  if (goals().cost_to_go().outside_bound() < kNever) return PathOutcome::kStopped;
  return outcome == PathOutcome::kAboveCutoff ? above_ : outcome;
}

PathOutcome FreeOrderSipp::Workspace::find_any() {
  for (;;) {
    const Time outside_bound = goals().cost_to_go().outside_bound();
    const Time optimal = std::max(outside_bound, search_.goals().first_rest());
    const std::optional<PathOutcome> outcome = find_within(std::min(latest_, optimal));
    if (!outcome) continue;
    if (*outcome != PathOutcome::kAboveCutoff) return *outcome;
    if (latest_ < outside_bound || outside_bound == kNever) return above_;
    if (goals().first_stage() != SequenceStages::kOutside) {
      if (const auto answer = check_feasibility()) return *answer;
      if (recompute_costs()) continue;
    }
    if (!goals().cost_to_go().extend(outside_bound, *limits_)) return PathOutcome::kStopped;
  }
}

// Searches for a path of cost at most `cap`; kAboveCutoff then refers to `cap`. Without inflation,
// a path that it finds has least cost if it costs at most outside_bound(). Returns nullopt if
// recompute_costs() replaced the stages and the search must restart.
std::optional<PathOutcome> FreeOrderSipp::Workspace::find_within(Time cap) {
  const bool all_known = goals().cost_to_go().outside_bound() == kNever;
  const SequenceStages::StageId first = goals().first_stage();
  if (first == SequenceStages::kOutside)
    return all_known ? PathOutcome::kInfeasible : PathOutcome::kAboveCutoff;
  search_.goals().begin(cap);
  search_.begin(goals().stops().start(), first, 0, others_, *limits_);
  for (;;) {
    switch (search_.run(std::min({abort_at_, check_feasibility_at_, recompute_costs_at_}))) {
      case Search::End::kFound:
        GROVE_ASSERT(search_.cost() <= cap && search_.cost() >= search_.goals().first_rest(),
                     "a path costs at most the cap and ends no earlier than the agent may rest");
        GROVE_ASSERT(goals().distance(first, goals().stops().start()) <= search_.cost(),
                     "the costs to go do not exceed the cost of a path");
        search_.write_path(*path_);
        return PathOutcome::kFound;
      case Search::End::kExhausted:
        return search_.goals().is_complete() ? PathOutcome::kInfeasible : PathOutcome::kAboveCutoff;
      case Search::End::kStopped:
        return PathOutcome::kStopped;
      case Search::End::kPaused:
        break;
    }
    if (search_.expanded() >= abort_at_) return PathOutcome::kStopped;
    if (search_.expanded() >= check_feasibility_at_)
      if (const auto answer = check_feasibility()) return answer;
    if (search_.expanded() >= recompute_costs_at_ && recompute_costs()) return std::nullopt;
  }
}

// Feasibility check, at most once per call of find(). Returns the outcome if it proves that no path
// exists or that every path costs more than latest_, or if a limit was reached; otherwise nullopt.
std::optional<PathOutcome> FreeOrderSipp::Workspace::check_feasibility() {
  if (check_feasibility_at_ == kNotAgain) return std::nullopt;
  check_feasibility_at_ = kNotAgain;
  const Time min_cost =
      visit_check_.min_cost(goals().stops(), search_.goals().first_rest(), *limits_);
  if (limits_->stop_requested()) return PathOutcome::kStopped;
  if (min_cost >= kNever) return PathOutcome::kInfeasible;
  return min_cost > latest_ ? std::optional(above_) : std::nullopt;
}

// Recomputes the costs of the legs, at most once per call of find(). Returns true if the search
// must restart with the new costs to go.
bool FreeOrderSipp::Workspace::recompute_costs() {
  if (recompute_costs_at_ == kNotAgain) return false;
  recompute_costs_at_ = kNotAgain;
  SequenceStages* const late = late_stages_.with_late_costs(goals(), *limits_);
  if (late) search_.goals().set_stages(*late);
  return late != nullptr;
}

}  // namespace grove::detail
