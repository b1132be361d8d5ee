// SPDX-License-Identifier: MIT
// Schedule of the primal search: individual planning of every agent (its best path without the
// others), then a first plan, then large neighbourhood search (LNS) from that plan.
//
// *States.* Two state machines run side by side: the planner (planner.h) and the improver
// (improver.h). Each piece of work goes to one of them. "-": the state owns no data. A transition
// that is not in these tables fails an assertion.
//
//   planner      owns                     transition when                            to
//   individual   next agent, adopted plan every agent has an individual path         first round
//   first round  efforts, label limit     prioritised planning has a plan            idle
//   idle         -                        LNS has stalled                            later round
//   later round  efforts, label limit     prioritised planning has a plan            idle
//                                         a plan is adopted                          idle
//
//   improver     owns                     transition when                            to
//   waiting      -                        a plan is adopted or taken over            LNS
//   LaCAM        LaCAM                    LaCAM fails, or memory is short            waiting
//                                         an expensive plan is found or adopted      guided
//                                         another plan is found or adopted           LNS
//                                         a plan is taken over                       LNS
//   guided       traffic-guided LaCAM,    several rounds bring no gain               LNS
//                rounds without gain      memory is short                            LNS
//                                         a plan is taken over                       LNS
//   LNS          use of guidance          an expensive plan is adopted, and guidance guided
//                                         is possible
//                                         another plan is adopted                    LNS
//                                         a plan is taken over                       LNS
//
// A plan of prioritised planning is *taken over* by the improver. A plan of another search is
// *adopted*; during individual planning it waits in the planner. A plan is *expensive* if its cost
// exceeds the sum of individual costs by a fraction of kMinLossForGuidance or more. The improver
// begins in the state waiting if LaCAM is not possible, otherwise in the state LaCAM. In the state
// LNS, guidance is possible after a transition from LaCAM, impossible after waiting, and used after
// guided.
//
// The improver has a current plan only in the states guided and LNS. As long as it has none,
// individual or prioritised planning is in progress. Only these combinations of states occur:
//
//                waiting   LaCAM   guided   LNS
//   individual      x        x
//   first round     x        x        x      x
//   idle                              x      x
//   later round                              x
//
// *Rounds.* LNS improves a plan quickly at first and then stalls in a local optimum; different
// seeds end in different optima. Therefore a new round starts, with prioritised planning, when LNS
// has spent as much effort without success as the round took to reach its best plan, and has made
// at least max(kStallNeighborhoods, kStallNeighborhoodsPerAgent * agents) iterations since that
// plan.
//
// *Definition.* W is the effort of individual planning for all agents (IndividualCosts::work).
//
// *First plan.* Prioritised planning has a head start: until its first failure, and for an effort
// of at most pp_head_start*W, it gets all effort. On instances that are not dense, prioritised
// planning ends within 1.5 W, with plans much cheaper than LaCAM's, which cost 1.1 to 3.5 times the
// sum of individual costs. After the head start, prioritised planning and LaCAM share the effort
// equally until one of them has a plan. A long low-level call of prioritised planning is postponed
// and repeated with twice the label limit, because a call that proves that an agent is enclosed can
// take longer than the tree search needs for a small instance.
//
// *Both continue.* If LaCAM finds a plan first (mostly within 2 W), LNS takes over that plan and
// LaCAM's half of the effort. Prioritised planning keeps the other half, because its plan, if it
// finds one, is mostly much cheaper. In the first round that plan replaces the current plan only if
// it is cheaper. Measured on room-64-64-8, 100 agents, 300 tasks: prioritised planning found a plan
// of cost 28,118 after an effort of 330,000 units, LaCAM one of cost 30,979 after 40,000 units. LNS
// had reduced the latter to 30,964 when prioritised planning ended. In the first round a plan
// adopted from another search does not end prioritised planning either. In later rounds prioritised
// planning shares the effort with the LNS of the previous round in the same way, so no round waits
// for a plan that is possibly never found.
//
// *Dense instances.* If the plan costs much more than the sum of individual costs, traffic-guided
// LaCAM (traffic_guided_lacam.cpp) continues from it, round by round, as long as it finds cheaper
// plans. LNS starts only afterwards, because it changes too few agents at a time to resolve a jam.
// On warehouse-10-20-10-2-1 with 900 agents, guided LaCAM reduced the cost from 206,729 to 115,468
// in six seconds, LNS only from 204,322 to 197,747 in four. Prioritised planning mostly fails on
// such instances. Therefore, once there is a plan and prioritised planning has spent
// pp_long_attempt*W, it gets only 1/9 of the effort (kOtherWorkPerLatePlanningWork).
//
// *Tree search.* The tree search waits for a much cheaper plan from prioritised planning or guided
// LaCAM (expects_plan()), but no longer than its root takes. The root examines all pairs of agents,
// so its effort is estimated as min(pp_long_attempt, W/root_work_per_individual_planning)*W.
//
// *Dual solutions* of the Lagrangian bound guide only LNS. Prioritised planning with penalties, or
// from the paths of the dual solution, yields cheaper plans than prioritised planning without them
// (3,976 instead of 4,246 for 150 agents on random-32-32-20), but by the time a dual solution
// exists LNS has found cheaper plans (3,830).
#include "primal/primal_search.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "model/effort.h"
#include "model/random.h"
#include "primal/best_plan.h"
#include "primal/improver.h"
#include "primal/planner.h"
#include "primal/primal_low_level.h"
#include "primal/round_progress.h"

namespace grove::detail {
namespace {

// Number of LaCAM steps within which a first plan is expected.
constexpr std::int64_t kLacamExpectedSteps = 4096;
// Effort of the other heuristics per unit of effort of long prioritised planning.
constexpr std::int64_t kOtherWorkPerLatePlanningWork = 8;

// LaCAM requires following: it lets an agent enter a place in the step in which another leaves it.
bool may_use_lacam(const Problem& problem, Techniques techniques) {
  return techniques.has(Technique::kLacam) && problem.instance.may_follow();
}

}  // namespace

class PrimalSearch::Impl {
 public:
  Impl(const Problem& problem, AgentStopsCache& stops, std::uint64_t seed, Techniques techniques,
       const Tuning& tuning)
      : tuning_(tuning),
        agents_(problem.instance.agent_count()),
        random_(seed),
        low_level_(problem, stops),
        planner_(problem, low_level_, random_, tuning_),
        improver_(problem, low_level_, planner_.individual_costs(), random_, seed,
                  may_use_lacam(problem, techniques), tuning_) {}

  std::optional<Plan> step(const Limits& limits);
  void adopt(const Plan& plan);
  void use(std::shared_ptr<const DualSolution> dual_solution) {
    if (dual_solution && dual_solution.get() != low_level_.dual_solution() &&
        is_near(dual_solution->bound()))
      low_level_.use(std::move(dual_solution));
  }

  PlanSource source() const { return best_.source(); }
  std::optional<Cost> best_cost() const {
    return best_.exists() ? std::optional(best_.cost()) : std::nullopt;
  }
  bool expects_plan() const;
  bool optimal() const {
    const IndividualCosts& individual = planner_.individual_costs();
    return planner_.knows_individual_costs() && individual.are_minimal &&
           best_.cost() <= individual.sum;
  }
  std::int64_t work() const {
    return low_level_.work() +
           (improver_.paths().steps_moved() + planner_.steps_moved()) / effort::kMovedSteps +
           improver_.joint_work();
  }
  std::int64_t work_at_last_plan() const { return work_at_last_plan_; }
  Counts counts() const {
    const Improver::JointSearch& joint = improver_.joint_search();
    return {steps_,
            planner_.attempts(),
            joint.first_plan_steps + joint.guided_steps,
            improver_.lns_iterations(),
            low_level_.calls(),
            low_level_.expanded()};
  }

 private:
  // True if the best plan is within lagrangian_lns_max_gap of `bound`. With a larger gap, a dual
  // solution predicts poorly which places and times are congested.
  bool is_near(ScaledCost bound) const {
    return static_cast<double>(best_.cost()) * Penalties::kUnit <=
           (1 + tuning_.lagrangian_lns_max_gap) * static_cast<double>(bound);
  }
  // Effort that the root of the tree takes, estimated ("Tree search" at the head).
  std::int64_t root_work() const {
    const std::int64_t work = planner_.individual_costs().work;
    return std::min(tuning_.pp_long_attempt, work / tuning_.root_work_per_individual_planning) *
           work;
  }
  bool may_report(const Limits& limits) const;
  void advance(const Limits& limits);
  void plan_individually(const Limits& limits);
  bool planning_is_due() const;
  void plan(const Limits& limits);
  void take_over_planned();
  void improve(const Limits& limits);
  bool has_stalled() const {
    return planner_.state() == Planner::State::kIdle &&
           progress_.has_stalled(work(), improver_.lns_iterations(), agents_);
  }
  void begin_later_round();
  void start_from(const Plan& plan);
  void note_gain() { progress_.note_gain(work(), improver_.lns_iterations()); }
  void check_states() const;

  const Tuning tuning_;
  const int agents_;
  Random random_;
  PrimalLowLevel low_level_;
  Planner planner_;
  Improver improver_;
  RoundProgress progress_;
  BestPlan best_;
  std::int64_t steps_ = 0;
  std::int64_t work_at_last_plan_ = 0;
};

std::optional<Plan> PrimalSearch::Impl::step(const Limits& limits) {
  ++steps_;
  const Cost before = best_.cost();
  if (has_stalled()) begin_later_round();
  for (const std::int64_t end = work() + tuning_.primal_step_work; work() < end && !optimal();) {
    if (limits.stop_requested()) break;
    advance(limits);
    if (!improver_.has_plan() || improver_.paths().cost() >= best_.cost()) continue;
    best_.keep(improver_.paths(), improver_.source());
    if (best_.source() != PlanSource::kLns) break;
  }
  check_states();
  if (best_.cost() < before) work_at_last_plan_ = work();
  if (!best_.is_unreported() || !may_report(limits)) return std::nullopt;
  Plan plan = low_level_.plan(best_.report(work()));
  GROVE_CHECK(plan.cost <= best_.cost(), "a plan costs at most as much as its paths");
  return plan;
}

// Making and checking a plan from its paths takes an effort of about one third of the plan's cost.
// Therefore, when LNS improves a plan in many small steps, only some of the plans are returned.
bool PrimalSearch::Impl::may_report(const Limits& limits) const {
  return best_.source() != PlanSource::kLns || optimal() || limits.stop_requested() ||
         best_.work_since_report(work()) >= tuning_.lns_report_work * best_.cost();
}

void PrimalSearch::Impl::advance(const Limits& limits) {
  if (!planner_.knows_individual_costs()) return plan_individually(limits);
  const std::int64_t before = work();
  if (planning_is_due()) {
    plan(limits);
    if (planner_.is_planning()) planner_.add_planning_work(work() - before);
    return;
  }
  improve(limits);
  if (planner_.is_planning()) planner_.add_other_work(work() - before);
}

void PrimalSearch::Impl::plan_individually(const Limits& limits) {
  if (!planner_.plan_individually(limits)) return;
  const std::optional<Plan> adopted = planner_.begin_first_round();
  progress_.begin_round(work());
  if (adopted) start_from(*adopted);
}

bool PrimalSearch::Impl::planning_is_due() const {
  if (!planner_.is_planning()) return false;
  if (!improver_.is_active()) return true;
  const std::int64_t individual = planner_.individual_costs().work;
  const std::int64_t spent = planner_.planning_work();
  const bool ahead = planner_.failures() == 0 && spent < tuning_.pp_head_start * individual;
  const bool takes_long = improver_.has_plan() && spent > tuning_.pp_long_attempt * individual;
  return ahead || spent <= planner_.other_work() / (takes_long ? kOtherWorkPerLatePlanningWork : 1);
}

void PrimalSearch::Impl::plan(const Limits& limits) {
  if (planner_.plan(limits, improver_.is_active())) take_over_planned();
}

void PrimalSearch::Impl::take_over_planned() {
  const bool first_round = planner_.state() == Planner::State::kFirstRound;
  PlannedPaths& planned = planner_.end_round();
  const bool is_worse = improver_.has_plan() && planned.cost() >= improver_.paths().cost();
  if (first_round && is_worse) return planned.clear();
  improver_.take_over(planned);  // plans of prioritised planning are mostly cheaper
  note_gain();
}

void PrimalSearch::Impl::improve(const Limits& limits) {
  if (improver_.step(limits)) note_gain();
}

void PrimalSearch::Impl::begin_later_round() {
  planner_.begin_later_round();
  progress_.begin_round(work());
}

void PrimalSearch::Impl::adopt(const Plan& plan) {
  if (plan.cost >= best_.cost()) return;
  best_.adopt(plan.cost);
  if (!planner_.knows_individual_costs()) return planner_.keep_adopted(plan);
  if (planner_.state() == Planner::State::kLaterRound) planner_.end_round().clear();
  if (!planner_.is_planning()) progress_.begin_round(work());
  start_from(plan);
  check_states();
}

void PrimalSearch::Impl::start_from(const Plan& plan) {
  improver_.start_from(plan, PlanSource::kStart);
  note_gain();
}

// The combinations of states at the head of this file.
void PrimalSearch::Impl::check_states() const {
  using Of = Planner::State;
  const Planner::State planner = planner_.state();
  GROVE_CHECK(improver_.has_plan() || planner == Of::kIndividual || planner == Of::kFirstRound,
              "without a plan individual or prioritised planning is in progress");
  GROVE_CHECK(!improver_.has_plan() || planner != Of::kIndividual,
              "a plan is improved only after individual planning");
  GROVE_CHECK(planner != Of::kLaterRound || improver_.state() == Improver::State::kLns,
              "during a later round LNS improves a plan");
  GROVE_CHECK(improver_.has_plan() || planner == Of::kIndividual || !best_.exists(),
              "after individual planning the improver has a plan if there is one");
}

bool PrimalSearch::Impl::expects_plan() const {
  if (!improver_.has_lacam() || optimal()) return false;
  if (!best_.exists()) return improver_.joint_search().first_plan_steps < kLacamExpectedSteps;
  const bool plans = planner_.state() == Planner::State::kFirstRound;
  const bool guides = improver_.state() == Improver::State::kGuided;
  return (plans && planner_.planning_work() < root_work()) ||
         (guides && improver_.joint_search().guided_work < root_work());
}

PrimalSearch::PrimalSearch(const Problem& problem, AgentStopsCache& stops, std::uint64_t seed,
                           Techniques techniques, const Tuning& tuning)
    : impl_(std::make_unique<Impl>(problem, stops, seed, techniques, tuning)) {}
PrimalSearch::~PrimalSearch() = default;

std::optional<Plan> PrimalSearch::step(const Limits& limits) {
  return impl_->step(limits);
}
PlanSource PrimalSearch::source() const {
  return impl_->source();
}
void PrimalSearch::adopt(const Plan& plan) {
  impl_->adopt(plan);
}
void PrimalSearch::use(std::shared_ptr<const DualSolution> dual_solution) {
  impl_->use(std::move(dual_solution));
}
std::optional<Cost> PrimalSearch::best_cost() const {
  return impl_->best_cost();
}
bool PrimalSearch::expects_plan() const {
  return impl_->expects_plan();
}
bool PrimalSearch::optimal() const {
  return impl_->optimal();
}
std::int64_t PrimalSearch::work() const {
  return impl_->work();
}
std::int64_t PrimalSearch::work_at_last_plan() const {
  return impl_->work_at_last_plan();
}
PrimalSearch::Counts PrimalSearch::counts() const {
  return impl_->counts();
}

}  // namespace grove::detail
