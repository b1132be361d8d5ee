// SPDX-License-Identifier: MIT
#include "engine/worker.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/joint_scheduler.h"
#include "engine/primal_scheduler.h"
#include "engine/solve.h"
#include "search/proof_log.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kRootWorkPerPair = 8;  // assumed effort for the root per pair of agents

constexpr double kGoldenRatio = 0.6180339887;  // its multiples spread evenly over [0, 1)

// Name of the statistics counter for splits of this kind.
std::string count_of_splits(ConstraintKind kind) {
  std::string name = "splits_" + std::string(split_name(kind));
  std::ranges::replace(name, '-', '_');
  return name;
}

// Runs `what` with the expander `by`, and records effort, counts and new cache entries in the item.
template <class What>
void run_and_measure(Worker::WorkItem& turn, Expander& by, const What& what) {
  by.use_shared_cache(turn.memory);
  const std::int64_t work = by.work();
  const ExpansionCounts counts = by.counts();
  what();
  turn.work = by.work() - work;
  turn.counts = by.counts();
  turn.counts -= counts;
  turn.found = by.take_delta();
}

}  // namespace

Worker::Worker(const Problem& problem, const SolveOptions& options, const Limits& limits,
               SharedSearch& shared, const AgentStopsCache& stops, int number)
    : problem_(problem),
      options_(options),
      limits_(limits),
      shared_(shared),
      number_(number),
      expander_stops_(stops),
      primal_stops_(stops),
      share_(std::make_unique<PrimalScheduler>(problem.instance.agent_count(), options.tuning)),
      joint_(std::make_unique<JointScheduler>(
          problem.instance, options.tuning,
          number == 0 && techniques_of(options).has(Technique::kJointSearch))) {
  // Counts the root in advance, because expanding it takes long if there are many pairs of agents.
  const std::int64_t agents = problem.instance.agent_count();
  share_->add_tree_work(kRootWorkPerPair * agents * agents);
  if (number == 0 && techniques_of(options).has(Technique::kLagrangian))
    shared.lagrangian().open(problem.instance, stops, options.proof != nullptr);
}

Worker::~Worker() = default;

std::optional<Worker::WorkItem> Worker::choose() {
  using Job = WorkItem::Job;
  const auto one = [&](Job job, NodePtr node = nullptr) {
    std::optional<WorkItem> turn(std::in_place, job, std::move(node));
    turn->memory = shared_.memory();
    return turn;
  };
  shared_.keep_within_memory();
  if (joint_->due() && !shared_.over()) return one(Job::kJoint);
  const auto lagrangian = [&] {
    std::optional<WorkItem> turn;
    if (shared_.over()) return turn;
    if (auto job = shared_.lagrangian().next()) {
      turn = one(Job::kLagrangian);
      turn->lagrangian = std::move(*job);
    }
    return turn;
  };
  if (shared_.lagrangian().due(shared_.shared_bounds().cutoff() < kInfiniteCost))
    if (auto turn = lagrangian()) return turn;
  const bool has_primal = techniques_of(options_).has(Technique::kPrimal);
  if (has_primal && share_->may_begin() && share_->due(primal())) return one(Job::kPrimal);
  if (NodePtr node = shared_.take()) {
    auto turn = one(Job::kExpand, std::move(node));
    turn->bounding_effort = shared_.bounding_effort();
    return turn;
  }
  if (NodePtr node = shared_.unfinished(); node && node != helped_)
    return one(Job::kHelp, std::move(node));
  if (has_primal && !shared_.over() && !primal().optimal()) return one(Job::kPrimal);
  if (shared_.trees().claim_preparation()) return one(Job::kPrepare);
  return lagrangian();
}

// Returns the primal search, updated with the incumbent and the latest dual solution.
PrimalSearch& Worker::primal() {
  if (!primal_)
    primal_ = std::make_unique<PrimalSearch>(problem_, primal_stops_,
                                             options_.seed + static_cast<std::uint64_t>(number_),
                                             options_.techniques, options_.tuning);
  if (const auto plan =
          shared_.shared_bounds().plan_below(primal_->best_cost().value_or(kInfiniteCost)))
    primal_->adopt(*plan);
  if (techniques_of(options_).has(Technique::kLagrangianLns))
    primal_->use(shared_.lagrangian().dual_solution());
  return *primal_;
}

Expander& Worker::expander() {
  if (!expander_)
    expander_ = std::make_unique<Expander>(
        problem_, expander_stops_, search_options_of(options_), shared_.memory(),
        make_agent_planner(options_.low_level, problem_.instance.world()));
  return *expander_;
}

void Worker::perform(WorkItem& turn, Expander& by) {
  switch (turn.job) {
    case WorkItem::Job::kExpand:
      return expand(turn, by);
    case WorkItem::Job::kHelp:
      return help(turn, by);
    case WorkItem::Job::kPrimal:
      return step_primal(turn);
    case WorkItem::Job::kPrepare:
      return shared_.trees().prepare_tree();
    case WorkItem::Job::kJoint:
      return step_joint(turn);
    case WorkItem::Job::kLagrangian:
      return step_lagrangian(turn);
  }
}

void Worker::expand(WorkItem& turn, Expander& by) const {
  run_and_measure(turn, by, [&] {
    turn.expansion =
        by.expand(turn.node, shared_.shared_bounds().cutoff(), limits_, turn.bounding_effort);
  });
}

void Worker::help(WorkItem& turn, Expander& by) {
  const double share = number_ * kGoldenRatio - std::floor(number_ * kGoldenRatio);
  run_and_measure(turn, by, [&] {
    if (!by.help(turn.node, shared_.shared_bounds().cutoff(), share, limits_)) helped_ = turn.node;
  });
}

void Worker::step_primal(WorkItem& turn) {
  const std::int64_t before = primal_->work();
  turn.plan = primal_->step(limits_);
  turn.work = primal_->work() - before;
}

void Worker::step_joint(WorkItem& turn) {
  turn.proven = joint_->step(shared_.shared_bounds().cutoff(), limits_);
  turn.plan = joint_->plan();
}

void Worker::step_lagrangian(WorkItem& turn) {
  if (!pricer_) pricer_.emplace(shared_.lagrangian().pricer(primal_stops_));
  const SharedBounds& shared_bounds = shared_.shared_bounds();
  shared_.lagrangian().perform(turn.lagrangian, *pricer_, shared_bounds.cutoff(),
                               shared_bounds.lower_bound(), limits_);
}

void Worker::publish(WorkItem& turn) {
  turn.memory->merge(std::exchange(turn.found, {}));
}

void Worker::commit(WorkItem& turn) {
  count(turn);
  if (turn.job == WorkItem::Job::kPrimal) {
    if (turn.plan) shared_.shared_bounds().post(std::move(*turn.plan), primal_->source());
    share_->add_primal_work(*primal_, turn.work);
    add_other_work(turn.work);
  } else if (turn.job == WorkItem::Job::kJoint) {
    if (turn.plan) shared_.shared_bounds().post(std::move(*turn.plan), PlanSource::kJointSearch);
    if (options_.proof != nullptr && turn.proven > shared_.shared_bounds().lower_bound())
      options_.proof->joint(turn.proven);
    shared_.shared_bounds().prove(turn.proven, BoundSource::kJointSearch);
  } else if (turn.job == WorkItem::Job::kLagrangian) {
    const Cost proven = shared_.lagrangian().commit(std::move(turn.lagrangian));
    if (proven > shared_.shared_bounds().lower_bound())
      shared_.shared_bounds().prove(proven, BoundSource::kLagrangian);
  } else if (turn.job != WorkItem::Job::kPrepare) {
    turn.memory->trim();
    if (turn.job == WorkItem::Job::kExpand)
      shared_.finish(turn.node, std::move(turn.expansion), number_);
    share_->add_tree_work(turn.work, {shared_.tree_bound_is_dominated(), shared_.gap_is_large()});
    add_other_work(turn.work);
  }
  shared_.observer().worked();
}

// Reports effort to the schedulers of the joint search and the Lagrangian bound.
void Worker::add_other_work(std::int64_t work) {
  joint_->add_other_work(work);
  shared_.lagrangian().add_other_work(work);
}

void Worker::count(const WorkItem& turn) {
  const std::lock_guard lock(counting_);
  of_tree_ += turn.counts;
  if (turn.job == WorkItem::Job::kPrimal) of_primal_ = primal_->counts();
  if (turn.job == WorkItem::Job::kHelp) ++helps_;
  joint_states_ = joint_->states();
}

void Worker::add_counts(Stats& stats) const {
  const std::lock_guard lock(counting_);
  const ExpansionCounts& tree = of_tree_;
  const PrimalSearch::Counts& primal = of_primal_;
  auto& counts = stats.counts;
  counts["low_level_calls"] += tree.low_level_calls;
  counts["low_level_expanded"] += tree.low_level_expanded;
  counts["pair_expansions"] += tree.pair_expansions;
  counts["joint_mdd_nodes"] += tree.joint_mdd_nodes;
  if (tree.group_states > 0) counts["group_states"] += tree.group_states;
  for (std::uint8_t kind = 0; kind < kConstraintKinds; ++kind)
    if (tree.splits[kind] > 0) counts[count_of_splits(*constraint_kind(kind))] += tree.splits[kind];
  counts["bypasses"] += tree.bypasses;
  counts["branching_cost_queries"] += tree.branching_cost_queries;
  counts["branching_cost_hits"] += tree.branching_cost_hits;
  counts["mdd_queries"] += tree.mdd_queries;
  counts["mdd_hits"] += tree.mdd_hits;
  counts["assists"] += helps_;
  if (joint_states_ > 0) counts["joint_states"] += joint_states_;
  counts["primal_steps"] += primal.steps;
  counts["primal_attempts"] += primal.attempts;
  counts["primal_lacam_steps"] += primal.joint_steps;
  counts["primal_lns_iterations"] += primal.neighborhoods;
  counts["primal_low_level_calls"] += primal.low_level_calls;
  counts["primal_low_level_expanded"] += primal.low_level_expanded;
}

}  // namespace grove::detail
