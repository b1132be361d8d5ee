// SPDX-License-Identifier: MIT
#include "worker.h"

#include <cmath>
#include <utility>

#include "techniques_of.h"

namespace grove {
namespace {

constexpr std::int64_t kRootWorkPerPair = 8;  // of agents
constexpr std::int64_t kWorkPerCall = 16;  // in labels: what a call of the low level costs beside
constexpr double kGoldenRatio = 0.6180339887;  // its multiples spread evenly over [0, 1)
constexpr std::int64_t kStepsPerWork = 4;      // of the paths of a node that is looked through

std::int64_t work_of(const ExpansionCounts& counts) {
  return counts.low_level_expanded + kWorkPerCall * counts.low_level_calls;
}

}  // namespace

Worker::Worker(const Problem& problem, const SolveOptions& options, const Limits& limits,
               SharedSearch& shared, int number)
    : problem_(problem),
      options_(options),
      limits_(limits),
      shared_(shared),
      number_(number),
      stops_(problem.instance, problem.distances),
      expander_(problem, stops_, techniques_of(options), options.seed, shared.memory()),
      share_(problem.instance.agent_count()) {
  // To expand the root can take long where there are many pairs of agents.
  const std::int64_t agents = problem.instance.agent_count();
  share_.tree_worked(kRootWorkPerPair * agents * agents);
}

bool Worker::choose() {
  shared_.keep_within_memory();
  const bool has_primal = techniques_of(options_).has(Technique::kPrimal);
  if (has_primal && share_.may_begin() && share_.due(primal()))
    job_ = Job::kPrimal;
  else if ((node_ = shared_.take()))
    job_ = Job::kExpand;
  else if ((node_ = shared_.unfinished()) && node_ != helped_)
    job_ = Job::kHelp;
  else if (has_primal && !shared_.over() && !primal().optimal())
    job_ = Job::kPrimal;
  else if (shared_.claim_preparation())
    job_ = Job::kPrepare;
  else
    return false;
  return true;
}

// The primal search, which knows the incumbent.
PrimalSearch& Worker::primal() {
  if (!primal_)
    primal_ = std::make_unique<PrimalSearch>(
        problem_, stops_, options_.seed + static_cast<std::uint64_t>(number_), options_.techniques);
  if (const auto plan = shared_.plan_below(primal_->best_cost().value_or(kInfiniteCost)))
    primal_->adopt(*plan);
  return *primal_;
}

void Worker::perform() {
  switch (job_) {
    case Job::kExpand:
      return expand();
    case Job::kHelp:
      return help();
    case Job::kPrimal:
      return step_primal();
    case Job::kPrepare:
      return shared_.prepare_tree();
  }
}

void Worker::expand() {
  const std::int64_t before = work_of(expander_.counts());
  expansion_ = expander_.expand(node_, shared_.cutoff(), limits_);
  work_ = work_of(expander_.counts()) - before + node_->cost() / kStepsPerWork + 1;
}

void Worker::help() {
  const double share = number_ * kGoldenRatio - std::floor(number_ * kGoldenRatio);
  const std::int64_t before = work_of(expander_.counts());
  if (!expander_.help(node_, shared_.cutoff(), share, limits_)) helped_ = node_;
  work_ = work_of(expander_.counts()) - before + node_->cost() / kStepsPerWork + 1;
  ++helps_;
}

void Worker::step_primal() {
  const std::int64_t before = primal_->work();
  plan_ = primal_->step(limits_);
  work_ = primal_->work() - before;
}

void Worker::commit() {
  if (job_ == Job::kPrimal) {
    if (plan_) shared_.post(*std::exchange(plan_, std::nullopt), primal_->source());
    share_.primal_worked(*primal_, work_);
  } else if (job_ != Job::kPrepare) {
    expander_.publish();
    expander_.turn_to(shared_.memory());
    const NodePtr node = std::exchange(node_, nullptr);
    if (job_ == Job::kExpand) shared_.finish(node, std::exchange(expansion_, {}));
    share_.tree_worked(work_);
  }
  shared_.tell(RunEvent::kProgress);
}

void Worker::add_counts(Stats& stats) const {
  const ExpansionCounts tree = expander_.counts();
  const auto primal = primal_ ? primal_->counts() : PrimalSearch::Counts();
  auto& counts = stats.counts;
  counts["low_level_calls"] += tree.low_level_calls;
  counts["low_level_expanded"] += tree.low_level_expanded;
  counts["pair_expansions"] += tree.pair_expansions;
  counts["helps"] += helps_;
  counts["primal_steps"] += primal.steps;
  counts["primal_attempts"] += primal.attempts;
  counts["primal_joint_steps"] += primal.joint_steps;
  counts["primal_neighborhoods"] += primal.neighborhoods;
  counts["primal_low_level_calls"] += primal.low_level_calls;
  counts["primal_low_level_expanded"] += primal.low_level_expanded;
}

}  // namespace grove
