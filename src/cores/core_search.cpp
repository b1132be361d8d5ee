// SPDX-License-Identifier: MIT
// The hard clauses are those of path_model.cpp. For each valid plan there is an assignment that
// satisfies them, in which within_a(e) is true exactly if agent a costs at most its least cost + e.
//
// *Bound.* Let x_a be the excess of agent a in a valid plan: the number of e with within_a(e)
// false. The cost of the plan is the sum of the least costs plus the sum of all x_a. The algorithm
// (OLL) maintains a set of soft literals of weight 1, at first within_a(0) for all a, and the
// invariant
//
//   sum of x_a  >=  raised + number of false soft literals                                     (1)
//
// for every valid plan and its assignment. If the hard clauses contradict a set C of soft literals
// (a *core*), at least one of them is false. Let k >= 1 be a number such that at least k are false.
// Let f be the number of false literals of C, f >= k, and let L_j be literals with: "f >= j implies
// L_j" (totalizer.h); for the assignment, L_j is true exactly if f >= j. Then f = k + number of
// true L_j, k < j <= |C|. So C can be replaced by the soft literals not L_j, and `raised` by raised
// + k. It suffices to add not L_(k+1) at first and the next one when it is in a core, because with
// fewer soft literals (1) is weaker. In the same way, if within_a(e) is in a core, within_a(e + 1)
// becomes a soft literal; it is false only if within_a(e) is, and x_a counts both. The sum of the
// least costs plus `raised` is therefore a lower bound, after each core.
//
// *Prices.* If agents pay for their choices (planning/agent_prices.h), all costs of agents are
// prices, and the sum of the least costs is reduced by the constant. A plan also costs the prices
// of the goals that no agent uses. When a model is a plan of paths without conflicts that leaves
// such goals unused, each unit of their prices becomes a soft literal "the goal is used", so that
// the sum in (1) contains the false ones.
//
// *Groups.* Let S be a set of agents such that each core so far depends on agents of S only, or on
// none of them. The steps above then prove (1) for the sum over S, with the increases by the cores
// of S and the soft literals of S: S costs at least that much more than the sum of its least costs.
//
// Conversely, let it be known that S costs at least k more. If the bound was raised by k' < k by
// cores of S, the soft literals of S form a core: with all of them true, the sum over S is k',
// because (1) is an equation for S if each totalizer and each agent of S has its next soft literal
// and all that follow from it. So the bound can be raised by k in k steps without the solver.
//
// *Cutoff.* Agent a of a plan that costs less than the cutoff has an excess of at most E = cutoff -
// 1 - sum of least costs. If within_a(e) with e >= E is in a core, it becomes a hard clause
// instead, which holds for all plans below the cutoff; so does the bound from then on. (The cutoff
// only falls, so the clause stays valid.)
//
// *Plans.* A model of all soft literals whose paths have no conflict is a valid plan. Its cost is
// lower_bound(), because no path has an excess beyond `raised`. Every other model violates a clause
// that is then added; for given levels of excess there are finitely many such clauses.
//
// *Proof.* With a proof log, each core is logged as the sum of its inputs, the negations of its
// literals (docs/proof.md, "formula"). A core of which k literals are false is logged as k cores:
// the first has all its literals, the others are not L_2, not L_3, ... alone.
//
// *Order.* Cores of disjoint sets are found first: a relaxed core adds its soft literals only after
// the next model. A core is minimised by leaving out one literal at a time, and k is raised while
// the solver refutes "at most k".
#include "cores/core_search.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr int kConflictsPerStep = 300;
constexpr int kConflictsToMinimize = 50;
constexpr int kConflictsToExhaust = 300;
constexpr int kRetries = 4;

}  // namespace

CoreSearch::CoreSearch(const Problem& problem, const AgentStopsCache& stops, Techniques techniques,
                       std::size_t max_bytes, const Limits& limits, ProofLog* proof,
                       std::uint64_t seed, PricedChoices choices)
    : max_bytes_(max_bytes),
      limits_(limits),
      random_(seed),
      is_shuffled_(seed != 0),
      model_(problem, stops, techniques, limits, proof, choices.prices),
      choices_(std::move(choices)) {}

CoreSearch::Outcome CoreSearch::step(Cost cutoff) {
  GROVE_CHECK(cutoff <= cutoff_, "the cutoff never rises");
  cutoff_ = cutoff;
  if (limits_.stop_requested()) return Outcome::kStopped;
  if (is_set_up() && lower_bound_ >= cutoff_) return Outcome::kSolved;
  if (model_.bytes() > max_bytes_) return Outcome::kTooLarge;
  switch (phase_) {
    case Phase::kSetUp:
      return set_up();
    case Phase::kSolve:
      return solve();
    case Phase::kMinimize:
      return minimize();
    case Phase::kExhaust:
      return exhaust();
    case Phase::kRelax:
      return relax();
  }
  GROVE_CHECK(false, "the search is in one of its phases");
}

CoreSearch::Outcome CoreSearch::set_up() {
  if (model_.plan_next_agent() != PathModel::Outcome::kDone) return stopped_or(Outcome::kTooLarge);
  if (model_.is_complete()) {
    lower_bound_ = model_.least_sum();
    phase_ = Phase::kSolve;
  }
  return Outcome::kWorking;
}

void CoreSearch::add(const GroupExcess& excess) {
  GROVE_CHECK(is_set_up(), "the agents of a statement are planned");
  if (excess.excess < kInfiniteCost) new_statements_.push_back(excess);
}

// Adds the clauses of one statement. When all have theirs, raises the bound by disjoint ones, those
// with the greatest excess per agent first.
CoreSearch::Outcome CoreSearch::use_statement() {
  if (!new_statements_.empty()) {
    model_.add(new_statements_.back());
    add_new_agents();
    statements_.push_back(std::move(new_statements_.back()));
    new_statements_.pop_back();
    if (new_statements_.empty())
      std::ranges::stable_sort(statements_, [](const GroupExcess& s, const GroupExcess& t) {
        return s.excess * std::ssize(t.agents) < t.excess * std::ssize(s.agents);
      });
    return Outcome::kWorking;
  }
  const GroupExcess excess = std::move(statements_.back());
  statements_.pop_back();
  const auto is_in_core = [&](AgentIndex agent) { return components_.contains(agent); };
  if (std::ranges::none_of(excess.agents, is_in_core)) raise_by(excess);
  return Outcome::kWorking;
}

void CoreSearch::raise_by(const GroupExcess& excess) {
  core_ = {};
  core_.further = excess.excess - 1;
  for (const AgentIndex agent : excess.agents) core_.softs.push_back(agent_soft(agent, 0));
  accept_core();
  start_relaxation();
}

CoreSearch::Outcome CoreSearch::solve() {
  if (!new_statements_.empty() || !statements_.empty()) return use_statement();
  switch (solve(active_, kConflictsPerStep)) {
    case SatSolver::Result::kUnknown:
      return stopped_or(Outcome::kWorking);
    case SatSolver::Result::kSatisfiable:
      return use_model();
    case SatSolver::Result::kUnsatisfiable:
      core_ = {.softs = failed(active_), .retries = kRetries};
      if (core_.softs.empty()) return prove_cutoff();
      phase_ = Phase::kMinimize;
      return Outcome::kWorking;
  }
  GROVE_CHECK(false, "the solver has one of three results");
}

// Uses a model of all active soft literals.
CoreSearch::Outcome CoreSearch::use_model() {
  const std::int64_t conflicts = add_conflicts();
  model_.prefer_paths();  // the next model contains most of these paths
  if (conflicts > 0) return Outcome::kWorking;
  if (!deferred_.empty()) {
    active_.insert(active_.end(), deferred_.begin(), deferred_.end());
    deferred_.clear();
    return Outcome::kWorking;
  }
  if (!model_.has_all_paths()) return Outcome::kTooLarge;
  if (choices_.prices && add_unused_goals()) return Outcome::kWorking;
  plan_ = choices_.prices ? choices_.make_plan(model_.counted_paths()) : model_.plan();
  GROVE_CHECK(plan_->cost <= lower_bound_, "a model of all soft literals costs the bound");
  return Outcome::kSolved;
}

// Adds soft literals for goals that the paths do not use. Returns false if there are none.
bool CoreSearch::add_unused_goals() {
  const std::vector<PathModel::UnusedGoal> unused = model_.take_unused_goals();
  for (const PathModel::UnusedGoal& goal : unused) {
    goals_.push_back(goal.agents);
    for (Time i = 0; i < goal.price; ++i) {
      const Literal literal = model_.solver().new_variable(FormulaKind::kUsed, {goal.place, i + 1});
      model_.solver().add({-literal, goal.is_used});
      active_.push_back({.literal = literal, .goal = static_cast<std::int32_t>(goals_.size()) - 1});
    }
  }
  add_new_agents();
  return !unused.empty();
}

// The hard clauses, which hold for all plans below the cutoff, have no model.
CoreSearch::Outcome CoreSearch::prove_cutoff() {
  model_.solver().log(FormulaKind::kClause, {});
  lower_bound_ = cutoff_;
  return Outcome::kSolved;
}

// Leaves out one literal of the core.
CoreSearch::Outcome CoreSearch::minimize() {
  if (core_.next == core_.softs.size() || core_.softs.size() == 1) {
    accept_core();
    return Outcome::kWorking;
  }
  std::vector<Soft> rest = core_.softs;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(core_.next));
  switch (solve(rest, kConflictsToMinimize)) {
    case SatSolver::Result::kUnsatisfiable: {
      core_.softs = failed(rest);
      core_.retries = kRetries;
      core_.next = std::min(core_.next, core_.softs.size());
      return core_.softs.empty() ? prove_cutoff() : Outcome::kWorking;
    }
    case SatSolver::Result::kSatisfiable:
      if (core_.retries-- > 0 && add_conflicts() > 0) return Outcome::kWorking;
      break;
    case SatSolver::Result::kUnknown:
      if (limits_.stop_requested()) return Outcome::kStopped;
      break;
  }
  ++core_.next;
  core_.retries = kRetries;
  return Outcome::kWorking;
}

// Raises the bound by the minimised core.
void CoreSearch::accept_core() {
  core_.violated = 1;
  phase_ = Phase::kExhaust;
  std::erase_if(active_, [&](const Soft& soft) {
    return std::ranges::find(core_.softs, soft.literal, &Soft::literal) != core_.softs.end();
  });
  ++cores_;
  ++lower_bound_;
  std::vector<Literal> inputs;
  for (const Soft& soft : core_.softs) inputs.push_back(-soft.literal);
  if (inputs.size() == 1) return log_core(model_.solver().log_sum(inputs));
  counts_.push_back({Totalizer(model_.solver(), inputs), agents_of(core_.softs)});
  log_core(counts_.back().totalizer.number());
}

// Tests whether more literals of the core are violated.
CoreSearch::Outcome CoreSearch::exhaust() {
  if (core_.violated < core_.softs.size()) {
    const Soft at_most = count_soft(counts_.size() - 1, core_.violated);
    if (solve({&at_most, 1}, kConflictsToExhaust) == SatSolver::Result::kUnsatisfiable) {
      const Literal violated = -at_most.literal;
      log_core(model_.solver().log_sum({&violated, 1}));
      model_.solver().add({violated});
      ++core_.violated;
      ++lower_bound_;
      return Outcome::kWorking;
    }
    if (limits_.stop_requested()) return Outcome::kStopped;
  }
  start_relaxation();
  return Outcome::kWorking;
}

void CoreSearch::start_relaxation() {
  components_.add(agents_of(core_.softs), static_cast<Cost>(core_.violated), !depends_on_cutoff_);
  replacements_.clear();
  if (core_.violated < core_.softs.size())
    replacements_.push_back(count_soft(counts_.size() - 1, core_.violated));
  core_.next = 0;
  phase_ = Phase::kRelax;
}

// Replaces one literal of the core, or does a part of it.
CoreSearch::Outcome CoreSearch::relax() {
  if (core_.next == core_.softs.size()) {
    finish_relaxation();
    return Outcome::kWorking;
  }
  const Soft& soft = core_.softs[core_.next];
  if (soft.agent >= 0) {
    const PathModel::Outcome outcome = raise(soft);
    if (outcome == PathModel::Outcome::kWorking) return Outcome::kWorking;
    if (outcome != PathModel::Outcome::kDone) return stopped_or(Outcome::kTooLarge);
  } else if (soft.totalizer >= 0 &&
             soft.count + 1 < counts_[soft.totalizer].totalizer.input_count()) {
    replacements_.push_back(count_soft(soft.totalizer, soft.count + 1));
  }
  ++core_.next;
  return Outcome::kWorking;
}

void CoreSearch::finish_relaxation() {
  if (core_.further > 0 && !replacements_.empty()) {
    core_ = {.softs = replacements_, .further = core_.further - 1};
    accept_core();
    start_relaxation();
    return;
  }
  deferred_.insert(deferred_.end(), replacements_.begin(), replacements_.end());
  core_ = {};
  phase_ = Phase::kSolve;
}

// Replaces "at most this excess" by "at most one more" or, at the cutoff, makes it a hard clause.
PathModel::Outcome CoreSearch::raise(const Soft& soft) {
  if (cutoff_ < kInfiniteCost && soft.excess + 1 > cutoff_ - 1 - model_.least_sum()) {
    model_.limit(soft.agent, soft.excess);
    depends_on_cutoff_ = true;
    return PathModel::Outcome::kDone;
  }
  const PathModel::Outcome outcome = model_.grow(soft.agent);
  if (outcome == PathModel::Outcome::kDone)
    replacements_.push_back(agent_soft(soft.agent, soft.excess + 1));
  return outcome;
}

SatSolver::Result CoreSearch::solve(std::span<const Soft> assumed, int max_conflicts) {
  std::vector<Literal> literals;
  for (const Soft& soft : assumed) literals.push_back(soft.literal);
  return model_.solve(std::move(literals), agents_of(assumed), max_conflicts);
}

std::int64_t CoreSearch::add_conflicts() {
  const std::int64_t conflicts = model_.add_conflicts();
  add_new_agents();
  return conflicts;
}

void CoreSearch::add_new_agents() {
  for (const AgentIndex agent : model_.take_new_agents()) {
    active_.push_back(agent_soft(agent, 0));
    // The order of assumptions decides which core the solver finds.
    if (is_shuffled_) std::swap(active_.back(), active_[random_.below(active_.size())]);
  }
}

// The agents on which soft literals depend, in ascending order.
std::vector<AgentIndex> CoreSearch::agents_of(std::span<const Soft> softs) const {
  std::vector<AgentIndex> agents;
  for (const Soft& soft : softs) {
    if (soft.agent >= 0)
      agents.push_back(soft.agent);
    else if (soft.goal >= 0)
      agents.insert(agents.end(), goals_[soft.goal].begin(), goals_[soft.goal].end());
    else
      agents.insert(agents.end(), counts_[soft.totalizer].agents.begin(),
                    counts_[soft.totalizer].agents.end());
  }
  std::ranges::sort(agents);
  const auto rest = std::ranges::unique(agents);
  agents.erase(rest.begin(), rest.end());
  return agents;
}

std::vector<CoreSearch::Soft> CoreSearch::failed(std::span<const Soft> assumed) {
  std::vector<Soft> core;
  for (const Soft& soft : assumed)
    if (model_.solver().failed(soft.literal)) core.push_back(soft);
  return core;
}

CoreSearch::Soft CoreSearch::agent_soft(AgentIndex agent, Time excess) {
  return {.literal = model_.within(agent, excess), .agent = agent, .excess = excess};
}

// "At most `count` inputs of the totalizer are true".
CoreSearch::Soft CoreSearch::count_soft(std::size_t totalizer, std::size_t count) {
  return {.literal = -counts_[totalizer].totalizer.at_least(count + 1),
          .totalizer = static_cast<std::int32_t>(totalizer),
          .count = count};
}

CoreSearch::Outcome CoreSearch::stopped_or(Outcome outcome) const {
  return limits_.stop_requested() ? Outcome::kStopped : outcome;
}

}  // namespace grove::detail
