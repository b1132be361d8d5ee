// SPDX-License-Identifier: MIT
// What the tree closes at once needs no other bound, so the tree begins; and a plan comes first.
// Where there are few agents the tree knows better (see lagrangian_agents), so it is not tried.
// Where it is, it has its part of the work until it is over: by itself,
// when it promises less than is proven already, or when nothing is to be gained any more.
#include "grove/detail/engine/lagrangian_share.h"

#include <new>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::int64_t kPatienceWithoutPlan = 10;  // times as much work of others

}  // namespace

void LagrangianShare::open(const Instance& instance, const AgentStopsStore& stops) {
  instance_ = &instance;
  stops_.emplace(stops);
  is_over_ = instance.agent_count() < tuning_.lagrangian_agents;
}

std::optional<LagrangianBound::Job> LagrangianShare::next(bool has_plan) {
  if (is_over_) return std::nullopt;
  const std::int64_t others = others_;
  const std::int64_t begin = tuning_.lagrangian_begins_work * (has_plan ? 1 : kPatienceWithoutPlan);
  if (others < begin ||
      static_cast<double>(own_) > tuning_.most_lagrangian * static_cast<double>(others))
    return std::nullopt;
  const std::lock_guard lock(making_);
  if (!bound_) make();
  return bound_ ? bound_->next() : std::nullopt;
}

// Without memory for it there is none.
void LagrangianShare::make() {
  try {
    bound_ = LagrangianBound::make(*instance_, *stops_, tuning_);
  } catch (const std::bad_alloc&) {
  }
  is_over_ = bound_ == nullptr;
}

Cost LagrangianShare::commit(LagrangianBound::Job job) {
  own_ += job.work;
  bound_->commit(std::move(job));
  rounds_ = bound_->rounds();
  if (bound_->ended()) is_over_ = true;
  return bound_->lower_bound();
}

}  // namespace grove::detail
