// SPDX-License-Identifier: MIT
// The low level over all sequences of a class at once: one safe-interval search
// (safe_interval_search.h, goals_in_class.h) within a cap, and what to do when that does not settle
// the question.
//
// Exactness with a bounded graph. The completions know every sequence cheaper than beyond(). Labels
// in states that they do not know are dropped, and so are labels of f > beyond().
// *Claim: no path that costs less than beyond() is lost.* Take such a path P that realizes a
// sequence of the class, and count as early as possible: that realizes a sequence s too. P visits
// the stops of s in turn, so s costs at most what P costs, less than beyond(): all states of s are
// known with their exact completions, which are at most what P still pays. So every label along P
// has t + h <= cost(P). The search may hold, instead of P's label, an earlier one of the same cell,
// interval and state; then the way there with the remainder of P after it, waiting in between, is
// again a path of the class, no dearer than P, and the argument holds for it: what the graph misses
// of other ways does not matter. With a deadline or gate it is the same path that goes on.
// So: a path found that costs at most beyond() is optimal, since a cheaper one would not have been
// lost. If none is found, every path costs at least beyond(); then the graph is widened and the
// search begun again, unless the cutoff is below beyond(): kAboveCutoff. And if no label was
// dropped for its f or for its state, the search has seen all there is: kInfeasible, whatever the
// graph.
//
// Graphs by direct legs (sequence_dag.cpp) know paths instead of sequences: all stages of a path of
// the class that costs less than beyond(), counted as early as possible, with completions that are
// at most what it still pays. So every label along P has t + h <= cost(P) there as well, and the
// rest of the argument is the same.
//
// Early ends. No path costs less than the first rest, so one that costs just that is optimal
// whatever its sequence: where the first rest is later than beyond(), labels are kept up to there.
//
// Late costs. Under cells barred for ever the completions know nothing of the way around, and a
// search that they mislead tries all orders. So once per hard call, and before the completions are
// widened, legs are priced anew (late_costs.cpp). If the best sequence costs more by these, then
// the search begins again with completions of its own over them. All of the above holds with these
// costs in place of the plain ones: a path through the stops of s costs at least what s costs, and
// what is left of it costs at least the completion from any of its states on.
//
// Cutoff. Labels of f > cutoff are dropped. "Above" then says no more than that no path costs the
// cutoff or less. That the agent must come to rest by t (kRestBy) is a cutoff of t and what it may
// have to turn and work there afterwards, but what is above it is infeasible: a path that comes to
// rest in time has one beside it that does the same up to then, and finishes without tarrying.
//
// Known sequences. A heuristic that wants any good path may do without the others: then the cap is
// the cutoff itself, a path found is one of a known sequence, and none found proves nothing, unless
// all are known.
//
// Doubt. Infeasible cases can cost all 2^n sets: with time windows the question is NP-hard; and so
// can cases far above the cutoff. Most are a door shut before or behind the agent, so once per hard
// call each stop is asked for alone (visit_check.cpp): a bound on the cost.
//
// Measured on the benchmark's 32x32 maps with obstacles (nine other agents, one core, median of a
// call in microseconds; n = 5, 10, 20): 6, 14, 24 without constraints; 17, 35, 57 with 20 of them
// on the paths found; 34, 64, 138 with 60. A fixed sequence takes 5, 8, 15; 12, 14, 22; 21, 24, 31.
#include "planning/free_order_sipp.h"

#include <algorithm>
#include <optional>

#include "planning/free_order_goals.h"
#include "planning/late_goals.h"
#include "planning/safe_interval_search.h"
#include "planning/single_stop_bound.h"

namespace grove::detail {
namespace {

// After so many in one call, or before the completions are widened a second time, it is worth
// asking whether each stop can be visited at all, or in time.
constexpr std::int64_t kExpansionsBeforeDoubt = 1 << 12;
// After so many in one call legs are priced anew: the work of some milliseconds, as pricing is.
constexpr std::int64_t kExpansionsBeforePricing = 1 << 13;

constexpr std::int64_t kNotAgain = PathQuery::kUnlimited;

}  // namespace

class FreeOrderSipp::Workspace {
 public:
  explicit Workspace(const World& world)
      : search_(world),
        visit_check_(world, search_.intervals()),
        late_goals_(world, search_.intervals()) {}

  PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits, Path& path);
  std::int64_t expanded() const { return search_.expanded(); }

 private:
  using Search = SafeIntervalSearch<FreeOrderGoals>;

  void decide_when(const PathQuery& query);
  PathOutcome find_any();
  PathOutcome find_known();
  std::optional<PathOutcome> find_within(Time cap);
  std::optional<PathOutcome> doubt();
  bool price_anew();
  SequenceStages& goals() { return search_.goals().free_goals(); }

  Search search_;
  SingleStopBound visit_check_;
  LateGoals late_goals_;

  // Of the call under way.
  const ConflictAvoidanceTable* others_ = nullptr;
  const Limits* limits_ = nullptr;
  Path* path_ = nullptr;
  Time latest_ = 0;                                // dearer paths are of no use,
  PathOutcome above_ = PathOutcome::kAboveCutoff;  // and this is the answer if all are
  // The counts of labels at which to do so.
  std::int64_t give_up_at_ = 0;
  std::int64_t doubt_at_ = 0;
  std::int64_t price_at_ = 0;
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
  decide_when(query);
  return query.known_sequences && goals.cost_to_go().beyond() <= query.cutoff ? find_known()
                                                                              : find_any();
}

void FreeOrderSipp::Workspace::decide_when(const PathQuery& query) {
  // Whoever gives up early around reservations wants no proof.
  const bool doubts = !query.reservations || query.label_limit == PathQuery::kUnlimited;
  give_up_at_ = search_.expanded_after(query.label_limit);
  doubt_at_ = doubts ? search_.expanded_after(kExpansionsBeforeDoubt) : kNotAgain;
  price_at_ = search_.expanded_after(kExpansionsBeforePricing);
}

PathOutcome FreeOrderSipp::Workspace::find_known() {
  price_at_ = kNotAgain;
  const PathOutcome outcome = *find_within(latest_);
  if (outcome == PathOutcome::kFound) return outcome;
  if (goals().cost_to_go().beyond() < kNever) return PathOutcome::kStopped;
  return outcome == PathOutcome::kAboveCutoff ? above_ : outcome;
}

PathOutcome FreeOrderSipp::Workspace::find_any() {
  for (;;) {
    const Time beyond = goals().cost_to_go().beyond();
    const Time optimal = std::max(beyond, search_.goals().first_rest());
    const std::optional<PathOutcome> outcome = find_within(std::min(latest_, optimal));
    if (!outcome) continue;
    if (*outcome != PathOutcome::kAboveCutoff) return *outcome;
    if (latest_ < beyond || beyond == kNever) return above_;
    if (goals().first_stage() != SequenceStages::kOutside) {
      if (const auto answer = doubt()) return *answer;
      if (price_anew()) continue;
    }
    if (!goals().cost_to_go().widen(beyond, *limits_)) return PathOutcome::kStopped;
  }
}

// A path of least cost, if the cost is at most `cap`; of least cost if that is at most beyond().
// None: the goals changed meanwhile, begin again.
std::optional<PathOutcome> FreeOrderSipp::Workspace::find_within(Time cap) {
  const bool all_known = goals().cost_to_go().beyond() == kNever;
  const SequenceStages::StageId first = goals().first_stage();
  if (first == SequenceStages::kOutside)
    return all_known ? PathOutcome::kInfeasible : PathOutcome::kAboveCutoff;
  search_.goals().begin(cap);
  search_.begin(goals().stops().start(), first, 0, others_, *limits_);
  for (;;) {
    switch (search_.run(std::min({give_up_at_, doubt_at_, price_at_}))) {
      case Search::End::kFound:
        search_.write_path(*path_);
        return PathOutcome::kFound;
      case Search::End::kExhausted:
        return search_.goals().is_complete() ? PathOutcome::kInfeasible : PathOutcome::kAboveCutoff;
      case Search::End::kStopped:
        return PathOutcome::kStopped;
      case Search::End::kPaused:
        break;
    }
    if (search_.expanded() >= give_up_at_) return PathOutcome::kStopped;
    if (search_.expanded() >= doubt_at_)
      if (const auto answer = doubt()) return answer;
    if (search_.expanded() >= price_at_ && price_anew()) return std::nullopt;
  }
}

// Is there surely no path, or none in time, or no time to find out? Asks once a call.
std::optional<PathOutcome> FreeOrderSipp::Workspace::doubt() {
  if (doubt_at_ == kNotAgain) return std::nullopt;
  doubt_at_ = kNotAgain;
  const Time least_cost =
      visit_check_.least_cost(goals().stops(), search_.goals().first_rest(), *limits_);
  if (limits_->stop_requested()) return PathOutcome::kStopped;
  if (least_cost >= kNever) return PathOutcome::kInfeasible;
  return least_cost > latest_ ? std::optional(above_) : std::nullopt;
}

// True if the search should begin again, with completions that know better. Once a call.
bool FreeOrderSipp::Workspace::price_anew() {
  if (price_at_ == kNotAgain) return false;
  price_at_ = kNotAgain;
  SequenceStages* const late = late_goals_.over(goals(), *limits_);
  if (late) search_.goals().turn_to(*late);
  return late != nullptr;
}

}  // namespace grove::detail
