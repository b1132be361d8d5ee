// SPDX-License-Identifier: MIT
// Decides when the Lagrangian bound gets effort.
//
// The tree search starts alone (for an effort of lagrangian_start_work), because an instance that
// it solves at once needs no other bound. A first plan is more urgent than the Lagrangian bound, so
// without an incumbent the bound starts only after ten times lagrangian_start_work. With fewer than
// lagrangian_min_agents agents the tree search gives the better bound, so the Lagrangian bound is
// not tried. Otherwise the bound gets its share of the effort (lagrangian_max_share) until it
// stops: it promises less than the proven bound, can gain no more, or has failed
// (PricingJob::failed). A worker that has nothing else to do works on it in any case.
//
// With several ranks, rank 0 owns the bound, and the other ranks solve pricing problems for it.
// They do so before all other work items, because the bound cannot continue without the subproblem
// values. The bound's share is a share of the effort of all ranks, which is estimated as rank 0's
// other effort times the number of ranks. However, rank 0 spends some of its time on its own nodes
// (kMaxLocalRatio), because the lower bound of the run depends on them, too.
#include "engine/lagrangian_scheduler.h"

#include <new>
#include <stdexcept>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::int64_t kPatienceWithoutPlan = 10;  // factor on lagrangian_start_work without a plan
constexpr double kMaxLocalRatio = 4;  // max. Lagrangian effort per unit of other effort, on rank 0

}  // namespace

void LagrangianScheduler::open(const Instance& instance, const AgentStopsCache& stops,
                               bool records_best_multipliers) {
  instance_ = &instance;
  records_best_multipliers_ = records_best_multipliers;
  stops_.emplace(stops);
  is_over_ = instance.agent_count() < tuning_.lagrangian_min_agents;
}

bool LagrangianScheduler::due(bool has_plan) const {
  if (helps_) return true;
  if (is_over_) return false;
  const std::int64_t others = others_;
  const std::int64_t begin = tuning_.lagrangian_start_work * (has_plan ? 1 : kPatienceWithoutPlan);
  if (others < begin) return false;
  const double here = static_cast<double>(others);
  return static_cast<double>(own_) <= tuning_.lagrangian_max_share * here * ranks_ &&
         (ranks_ == 1 || static_cast<double>(own_here_) <= kMaxLocalRatio * here);
}

std::optional<LagrangianBound::Job> LagrangianScheduler::next() {
  if (helps_) return help_->next();
  if (is_over_) return std::nullopt;
  const std::lock_guard lock(making_);
  if (!bound_) make();
  return bound_ ? bound_->next() : std::nullopt;
}

// If there is not enough memory, the run does without a Lagrangian bound.
void LagrangianScheduler::make() {
  try {
    bound_ = LagrangianBound::make(*instance_, *stops_, tuning_);
    if (bound_) bound_->set_helpers(ranks_ - 1);
    if (bound_ && records_best_multipliers_) bound_->record_best_multipliers();
  } catch (const std::bad_alloc&) {
    bound_.reset();
  }
  is_over_ = bound_ == nullptr;
}

// Returns nullptr until make() has succeeded.
LagrangianBound* LagrangianScheduler::bound() const {
  const std::lock_guard lock(making_);
  return bound_.get();
}

std::shared_ptr<const DualSolution> LagrangianScheduler::dual_solution() const {
  const LagrangianBound* const bound = this->bound();
  return bound == nullptr ? nullptr : bound->dual_solution();
}

bool LagrangianScheduler::has_jobs() const {
  if (helps_) return help_->has_jobs();
  const LagrangianBound* const bound = is_over_ ? nullptr : this->bound();
  return bound != nullptr && bound->has_jobs();
}

void LagrangianScheduler::perform(LagrangianBound::Job& job, Pricer& pricer, Cost cutoff,
                                  Cost known, const Limits& limits) {
  if (helps_)
    pricer.perform(job, limits);
  else
    bound_->perform(job, pricer, cutoff, known, limits);
}

Pricer LagrangianScheduler::pricer(const AgentStopsCache& stops) const {
  return {helps_ ? help_->multipliers() : bound_->multipliers(), stops};
}

Cost LagrangianScheduler::commit(LagrangianBound::Job job) {
  if (helps_) {
    help_->commit(std::move(job));
    return 0;
  }
  own_ += job.work;
  own_here_ += job.work;
  bound_->commit(std::move(job));
  return update_from_bound();
}

void LagrangianScheduler::log_proof(ProofLog& proof) const {
  const LagrangianBound* const bound = this->bound();
  if (bound != nullptr && !bound->best_multipliers().empty())
    proof.prices(bound->lower_bound(), bound->best_multipliers());
}

Cost LagrangianScheduler::update_from_bound() {
  rounds_ = bound_->rounds();
  if (bound_->ended()) is_over_ = true;
  return bound_->lower_bound();
}

// Helper h is rank h + 1, because rank 0 is no helper. Requested effort counts as spent when the
// request is made, so that rank 0 does other work items in the meantime.
std::vector<std::pair<int, PricingRequest>> LagrangianScheduler::dispatch_pricing() {
  std::vector<std::pair<int, PricingRequest>> requests;
  LagrangianBound* const bound = is_over_ ? nullptr : this->bound();
  if (bound == nullptr) return requests;
  for (auto& [helper, work, request] : bound->dispatch_pricing()) {
    own_ += expected_work_[static_cast<std::size_t>(helper + 1)] = work;
    requests.emplace_back(helper + 1, std::move(request));
  }
  return requests;
}

Cost LagrangianScheduler::accept(int rank, PricingReply answer) {
  LagrangianBound* const bound = this->bound();
  if (bound == nullptr || rank < 1 || rank >= ranks_)
    throw std::invalid_argument("pricing result: the rank has no outstanding request");
  own_ += answer.work - expected_work_[static_cast<std::size_t>(rank)];
  remote_pricings_ += bound->accept(rank - 1, std::move(answer));
  return update_from_bound();
}

void LagrangianScheduler::help(const Instance& instance, PricingRequest request) {
  const std::lock_guard lock(making_);
  if (!help_) help_ = std::make_unique<RemotePricing>(instance);
  help_->accept(std::move(request));
  helps_ = true;
}

std::optional<PricingReply> LagrangianScheduler::take_answer() {
  return helps_ ? help_->take_answer() : std::nullopt;
}

}  // namespace grove::detail
