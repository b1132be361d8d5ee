// SPDX-License-Identifier: MIT
// The component that searches joint states (joint/epea_star.h).
//
// *Share.* The tree search starts alone, because its first nodes solve most small instances. In an
// unsolved instance with few joint states, all agents are often in each other's way. Then the joint
// search ends soon, but the tree search may never end. It is not known in advance which of the two
// ends first, so they share the effort: after joint_start_work, the joint search gets up to
// joint_max_share units per unit of other effort. Once it has ended or exceeded its memory limit,
// it gets no more effort.
//
// Only worker 0 of the run performs it, because it is one sequential search.
#include <algorithm>
#include <cstddef>
#include <mutex>

#include "engine/components.h"
#include "joint/epea_star.h"
#include "model/assert.h"
#include "search/proof_log.h"

namespace grove::detail {
namespace {

constexpr double kMaxLog2States = 44;  // at most 2^44 joint states

constexpr std::size_t kMaxJointBytes = std::size_t{1} << 30;

class JointWork : public WorkSource {
 public:
  JointWork(const ComponentContext& context, EffortAccount& account)
      : WorkSource(account), context_(context) {}

  std::int64_t start_effort() const override { return context_.options.tuning.joint_start_work; }
  Claim claim() override { return {.is_open = !over_}; }
  Share share(std::int64_t /*lower_tier_effort*/) override {
    const double most = context_.options.tuning.joint_max_share;
    return {.wanted = most, .cap = most};
  }
  bool uses_idle_time() const override { return false; }
  std::unique_ptr<WorkItem> next() override;

  void add_counts(Counters& counters) const override { counters[Counter::kJointStates] += states_; }

 private:
  class Item;

  // Results of about a millisecond of the search.
  struct Progress {
    Cost proven = 0;  // in the sense of SharedBounds::prove(); 0 if the search is impossible
    std::optional<Plan> plan;
    std::int64_t work = 0;
    std::int64_t states = 0;
  };
  Progress run();

  const ComponentContext& context_;
  bool over_ = false;
  std::unique_ptr<EpeaStar> search_;  // made when first due
  Cost proven_ = 0;                   // the greatest bound so far
  std::atomic<std::int64_t> states_{0};
};

class JointWork::Item : public WorkItem {
 public:
  explicit Item(JointWork& work) : work_(work) {}

  std::string_view name() const override { return "joint search"; }
  void perform(Workspace&) override {
    progress_ = work_.run();
    set_effort(progress_.work, 0);
  }
  void commit() override {
    SharedBounds& bounds = work_.context_.bounds;
    work_.states_ = progress_.states;
    if (progress_.plan) bounds.post(std::move(*progress_.plan), PlanSource::kJointSearch);
    ProofLog* const proof = work_.context_.options.proof;
    if (proof != nullptr && progress_.proven > bounds.lower_bound()) proof->joint(progress_.proven);
    bounds.prove(progress_.proven, ComponentId::kJoint);
  }

 private:
  JointWork& work_;
  Progress progress_;
};

std::unique_ptr<WorkItem> JointWork::next() {
  return std::make_unique<Item>(*this);
}

JointWork::Progress JointWork::run() {
  using Outcome = EpeaStar::Outcome;
  const std::int64_t before = search_ ? search_->work() : 0;
  if (!search_)
    search_ = EpeaStar::make(context_.problem.instance, kMaxLog2States, at_most_a_quarter(kMaxJointBytes, context_.limits));
  over_ = search_ == nullptr;
  if (over_) return {};
  const Cost cutoff = context_.bounds.cutoff();
  auto outcome = Outcome::kWorking;
  const std::int64_t end = search_->work() + context_.options.tuning.joint_step_work;
  while (search_->work() < end && outcome == Outcome::kWorking)
    outcome = search_->run(1, cutoff, context_.limits);
  over_ = outcome != Outcome::kWorking;
  Progress progress{search_->lower_bound(), search_->plan(), search_->work() - before,
                    search_->states()};
  GROVE_CHECK(progress.proven >= proven_, "the bound of the joint search never falls");
  proven_ = progress.proven;
  if (outcome == Outcome::kTooLarge) {
    search_.reset();  // frees memory for the tree search
    progress.plan.reset();
  }
  return progress;
}

class JointComponent : public Component {
 public:
  explicit JointComponent(const ComponentContext& context) : context_(context) {}

  EffortTier tier() const override { return EffortTier::kBound; }
  std::unique_ptr<WorkSource> source(int worker) override {
    return worker == 0 ? std::make_unique<JointWork>(context_, account_) : nullptr;
  }

 private:
  const ComponentContext& context_;
  EffortAccount account_;
};

}  // namespace

std::unique_ptr<Component> make_joint_component(const ComponentContext& context) {
  if (!techniques_of(context.options).has(Technique::kJointSearch) ||
      context.problem.instance.agent_count() > EpeaStar::kMaxAgents)
    return nullptr;
  return std::make_unique<JointComponent>(context);
}

}  // namespace grove::detail
