// SPDX-License-Identifier: MIT
// Divides the effort between tree search and joint search. The tree search starts alone, because
// its first nodes solve most small instances. In an unsolved instance with few joint states, often
// all agents are in each other's way; there the joint search ends soon, and the tree search perhaps
// never. It is not known in advance which of the two ends first, so they share the effort: joint
// search gets up to joint_max_share units per unit of other effort. When joint search has ended or
// exceeds its memory, it gets no more effort.
#include "engine/joint_scheduler.h"

#include <algorithm>
#include <cstddef>

namespace grove::detail {
namespace {

constexpr double kMaxLog2States = 44;  // at most 2^44 joint states

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

std::size_t max_bytes(const Limits& limits) {
  const auto limit = limits.memory_limit();
  return limit ? std::min(kMaxBytes, *limit / 4) : kMaxBytes;
}

}  // namespace

JointScheduler::JointScheduler(const Instance& instance, const Tuning& tuning, bool wanted)
    : instance_(instance),
      tuning_(tuning),
      over_(!wanted || instance.agent_count() > EpeaStar::kMaxAgents) {}

bool JointScheduler::due() const {
  if (over_ || others_ < tuning_.joint_start_work) return false;
  const auto allowed = tuning_.joint_max_share * static_cast<double>(others_);
  return !search_ || static_cast<double>(search_->work()) <= allowed;
}

Cost JointScheduler::step(Cost cutoff, const Limits& limits) {
  if (!search_) search_ = EpeaStar::make(instance_, kMaxLog2States, max_bytes(limits));
  over_ = search_ == nullptr;
  if (over_) return 0;
  auto outcome = EpeaStar::Outcome::kWorking;
  for (const std::int64_t end = search_->work() + tuning_.joint_step_work;
       search_->work() < end && outcome == EpeaStar::Outcome::kWorking;)
    outcome = search_->run(1, cutoff, limits);
  over_ = outcome != EpeaStar::Outcome::kWorking;
  states_ = search_->states();
  const Cost proven = search_->lower_bound();
  if (outcome == EpeaStar::Outcome::kTooLarge) search_.reset();  // free its memory for the tree
  return proven;
}

std::optional<Plan> JointScheduler::plan() const {
  return search_ ? search_->plan() : std::nullopt;
}

}  // namespace grove::detail
