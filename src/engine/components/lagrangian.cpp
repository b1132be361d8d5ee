// SPDX-License-Identifier: MIT
// The component that computes the Lagrangian bound (lagrangian/lagrangian_bound.h).
//
// *Share.* The tree search starts alone (for an effort of lagrangian_start_work), because an
// instance that it solves at once needs no other bound. A first plan is more urgent than the
// Lagrangian bound, so without an incumbent the bound starts only after ten times
// lagrangian_start_work. With fewer than lagrangian_min_agents agents the tree search gives the
// better bound, so the Lagrangian bound is not tried. Otherwise the bound gets its share of the
// effort (lagrangian_max_share) until it ends, because it promises less than the proven bound, can
// rise no further, or has failed (PricingJob::failed). A worker that has nothing else to do works
// on it regardless of the share.
//
// With several ranks, rank 0 owns the bound, and the other ranks solve pricing problems for it.
// They do so before all other work items, because the bound cannot continue without the subproblem
// values. The bound's share is a share of the effort of all ranks, which is estimated as rank 0's
// other effort times the number of ranks. However, rank 0 spends some of its time on its own nodes
// (kMaxLocalRatio), because the lower bound of the run depends on them, too.
#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/components.h"
#include "engine/components/lagrangian_messages.h"
#include "lagrangian/pricing_queue.h"
#include "lagrangian/remote_pricing.h"
#include "model/assert.h"
#include "search/proof_log.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kPatienceWithoutPlan = 10;  // factor on lagrangian_start_work without a plan
constexpr double kMaxLocalRatio = 4;  // max. Lagrangian effort per unit of other effort, on rank 0

// A job of the bound, performed by the pricer of a worker.
template <class Owner>
class PricingItem : public WorkItem {
 public:
  // All references must outlive this object. `pricer`: made by the first item.
  PricingItem(Owner& owner, std::optional<Pricer>& pricer, PricingJob job)
      : owner_(owner), pricer_(pricer), job_(std::move(job)) {}

  std::string_view name() const override { return "pricing"; }
  void perform(Workspace&) override {
    if (!pricer_) pricer_.emplace(owner_.multipliers(), owner_.context().stops);
    owner_.perform(job_, *pricer_);
    set_effort(job_.work, static_cast<double>(job_.work));
  }
  void commit() override { owner_.commit(std::move(job_)); }

 private:
  Owner& owner_;
  std::optional<Pricer>& pricer_;
  PricingJob job_;
};

template <class Owner>
class PricingWork : public WorkSource {
 public:
  PricingWork(Owner& owner, EffortAccount& account) : WorkSource(account), owner_(owner) {}

  std::int64_t start_effort() const override { return owner_.start_effort(); }
  Claim claim() override { return owner_.claim(); }
  Share share(std::int64_t /*lower_tier_effort*/) override { return owner_.share(); }
  std::unique_ptr<WorkItem> next() override {
    auto job = owner_.next();
    if (!job) return nullptr;
    return std::make_unique<PricingItem<Owner>>(owner_, pricer_, std::move(*job));
  }

 private:
  Owner& owner_;
  std::optional<Pricer> pricer_;  // of this worker
};

// The component on rank 0, which owns the bound.
class LagrangianOwner : public Component {
 public:
  explicit LagrangianOwner(const ComponentContext& context)
      : context_(context),
        account_(
            {.max_local_ratio = context.ranks > 1 ? std::optional(kMaxLocalRatio) : std::nullopt}),
        helpers_(context.ranks - 1),
        expected_work_(static_cast<std::size_t>(context.ranks)) {}

  EffortTier tier() const override { return EffortTier::kBound; }
  std::unique_ptr<WorkSource> source(int /*worker*/) override {
    return std::make_unique<PricingWork<LagrangianOwner>>(*this, account_);
  }
  bool has_work() const override {
    const PricingQueue* const queue = is_over_ ? nullptr : this->queue();
    return queue != nullptr && queue->has_jobs();
  }
  void add_counts(Counters& counters) const override {
    counters[Counter::kLagrangianRounds] += rounds_;
    counters[Counter::kRemotePricings] += remote_pricings_;
  }
  void log_proof(ProofLog& proof) const override;
  std::vector<std::pair<int, ComponentMessage>> take_messages() override;
  void receive(int from, const ComponentMessage& message) override;

  const ComponentContext& context() const { return context_; }
  std::int64_t start_effort() const {
    return context_.options.tuning.lagrangian_start_work *
           (context_.bounds.cutoff() < kInfiniteCost ? 1 : kPatienceWithoutPlan);
  }
  Claim claim() const { return {.is_open = !is_over_}; }
  Share share() const {
    const double most = context_.options.tuning.lagrangian_max_share * context_.ranks;
    return {.wanted = most, .cap = most};
  }
  const Multipliers& multipliers() const { return queue()->multipliers(); }
  std::optional<PricingJob> next();
  void perform(PricingJob& job, Pricer& pricer) {
    queue()->perform(job, pricer, context_.bounds.cutoff(), context_.bounds.lower_bound(),
                     context_.limits);
  }
  void commit(PricingJob job) {
    queue()->commit(std::move(job));
    post_results();
  }

 private:
  void make();
  PricingQueue* queue() const;
  void post_results();

  const ComponentContext& context_;
  EffortAccount account_;
  std::atomic<bool> is_over_{false};
  mutable std::mutex making_;
  std::unique_ptr<PricingQueue> queue_;  // made when first due; guarded by making_
  std::mutex posting_;
  std::atomic<int> rounds_{0};

  // Changed only by the communicating thread.
  PricingDispatcher helpers_;                // helper h is rank h + 1
  std::vector<std::int64_t> expected_work_;  // by rank: expected effort of its request
  std::atomic<std::int64_t> remote_pricings_{0};
};

// Returns nullptr until make() has succeeded.
PricingQueue* LagrangianOwner::queue() const {
  const std::lock_guard lock(making_);
  return queue_.get();
}

std::optional<PricingJob> LagrangianOwner::next() {
  if (is_over_) return std::nullopt;
  {
    const std::lock_guard lock(making_);
    if (!queue_) make();
  }
  return is_over_ ? std::nullopt : queue()->next();
}

// If there is not enough memory, the run continues without a Lagrangian bound.
void LagrangianOwner::make() {
  const Tuning& tuning = context_.options.tuning;
  try {
    auto bound = LagrangianBound::make(context_.problem.instance, context_.stops, tuning);
    if (bound && context_.options.proof != nullptr) bound->record_best_multipliers();
    if (bound) queue_ = std::make_unique<PricingQueue>(std::move(bound), tuning);
  } catch (const std::bad_alloc&) {
    queue_.reset();
  }
  is_over_ = queue_ == nullptr;
}

// Results are posted in the order in which they are read.
void LagrangianOwner::post_results() {
  const std::lock_guard lock(posting_);
  const PricingQueue& queue = *this->queue();
  rounds_ = queue.rounds();
  if (queue.ended()) is_over_ = true;
  context_.results.set_dual_solution(queue.dual_solution());
  const Cost proven = queue.lower_bound();
  if (proven > context_.bounds.lower_bound())
    context_.bounds.prove(proven, ComponentId::kLagrangian);
}

void LagrangianOwner::log_proof(ProofLog& proof) const {
  const PricingQueue* const queue = this->queue();
  if (queue == nullptr || queue->bound().best_multipliers().empty()) return;
  proof.prices(queue->lower_bound(), queue->bound().best_multipliers());
}

// Requested effort counts as spent as soon as the request is made, so that rank 0 does other work
// items in the meantime.
std::vector<std::pair<int, ComponentMessage>> LagrangianOwner::take_messages() {
  std::vector<std::pair<int, ComponentMessage>> messages;
  PricingQueue* const queue = is_over_ ? nullptr : this->queue();
  if (queue == nullptr) return messages;
  for (const auto& [helper, work, request] : helpers_.dispatch(*queue)) {
    const int rank = helper + 1;
    account_.spend(expected_work_.at(static_cast<std::size_t>(rank)) = work, true);
    messages.emplace_back(rank, ComponentMessage{ComponentId::kLagrangian, bytes_of(request)});
  }
  return messages;
}

void LagrangianOwner::receive(int from, const ComponentMessage& message) {
  PricingQueue* const queue = this->queue();
  if (queue == nullptr || from < 1 || from >= context_.ranks)
    throw std::invalid_argument("pricing result: the rank has no outstanding request");
  PricingReply reply = pricing_reply_of(message.bytes);
  account_.spend(reply.work - expected_work_.at(static_cast<std::size_t>(from)), true);
  remote_pricings_ += helpers_.accept(from - 1, std::move(reply), *queue);
  post_results();
}

// The component on another rank, which solves pricing problems for rank 0.
class LagrangianHelper : public Component {
 public:
  explicit LagrangianHelper(const ComponentContext& context) : context_(context) {}

  EffortTier tier() const override { return EffortTier::kBound; }
  std::unique_ptr<WorkSource> source(int /*worker*/) override {
    return std::make_unique<PricingWork<LagrangianHelper>>(*this, account_);
  }
  bool has_work() const override { return is_asked_ && helper_->has_jobs(); }
  std::vector<std::pair<int, ComponentMessage>> take_messages() override {
    std::vector<std::pair<int, ComponentMessage>> messages;
    if (is_asked_)
      if (const auto reply = helper_->take_reply())
        messages.emplace_back(0, ComponentMessage{ComponentId::kLagrangian, bytes_of(*reply)});
    return messages;
  }
  void receive(int from, const ComponentMessage& message) override;

  const ComponentContext& context() const { return context_; }
  std::int64_t start_effort() const { return 0; }
  Claim claim() const { return {.is_urgent = is_asked_}; }
  Share share() const { return {}; }
  const Multipliers& multipliers() const { return helper_->multipliers(); }
  std::optional<PricingJob> next() { return is_asked_ ? helper_->next() : std::nullopt; }
  void perform(PricingJob& job, Pricer& pricer) const { pricer.perform(job, context_.limits); }
  void commit(PricingJob job) { helper_->commit(std::move(job)); }

 private:
  const ComponentContext& context_;
  EffortAccount account_;
  std::atomic<bool> is_asked_{false};      // true once helper_ is made
  std::unique_ptr<PricingHelper> helper_;  // made at the first request
};

void LagrangianHelper::receive(int from, const ComponentMessage& message) {
  if (from != 0) throw std::invalid_argument("pricing request: from a rank other than 0");
  if (!helper_) helper_ = std::make_unique<PricingHelper>(context_.problem.instance);
  helper_->accept(pricing_request_of(message.bytes));
  is_asked_ = true;
}

}  // namespace

std::unique_ptr<Component> make_lagrangian_component(const ComponentContext& context) {
  if (!techniques_of(context.options).has(Technique::kLagrangian) ||
      context.problem.instance.agent_count() < context.options.tuning.lagrangian_min_agents)
    return nullptr;
  if (context.rank == 0) return std::make_unique<LagrangianOwner>(context);
  return std::make_unique<LagrangianHelper>(context);
}

}  // namespace grove::detail
