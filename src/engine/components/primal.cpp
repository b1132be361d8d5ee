// SPDX-License-Identifier: MIT
// The component that runs the primal search (primal/primal_search.h). Each worker has a primal
// search of its own, with its own seed.
//
// *Share.* Once the tree search has spent kStartWork, the primal search may spend r units per unit
// of tree effort, 1/32 <= r <= 8:
// - With a plan, r = 8 x^3, where x = (primal effort at the last improvement) / (primal effort so
//   far). x is 1 right after an improvement, and 1/2 when the same effort again brought none. So r
//   is 8, 1 and 1/8 for x of 1, 1/2 and 1/4.
// - Without a plan, r = 8, because without an incumbent nothing is pruned, and a run that reaches a
//   limit has no result. After two failed attempts per agent r = 1, because the instance may have
//   no plan. While the primal search expects a plan soon, its claim is urgent, because expanding
//   the root of a large instance can take seconds.
// - Floor: r >= 1 while the bound proven outside the tree search exceeds the tree's bound, because
//   then tree effort does not raise the lower bound, and while the gap exceeds large_gap, because
//   then the tree search will not close the gap soon. Without the floor r could fall too low, since
//   neighbourhoods can fail a hundred times before the first of many gains.
// - Cap: r <= clamp(8 t, 1/4, 8), where t = (tree effort) / primal_full_share_work, because the
//   tree search solves most small instances within tenths of a second, whatever the incumbent.
//   While the gap exceeds large_gap, the cap is 8.
// r depends neither on the size of the instance nor on the speed of the machine. The numbers are
// the constants below and the defaults of tunables.def.
#include "engine/components/primal.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/components.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kStartWork = 2000;     // tree effort before the primal search starts
constexpr std::int64_t kRootWorkPerPair = 8;  // assumed effort for the root per pair of agents
constexpr double kMaxShare = 8;               // maximum of r
constexpr double kMinShare = 1.0 / 32;        // minimum of r with a plan
// Failed attempts of prioritised planning per agent after which r falls.
constexpr std::int64_t kFailedAttemptsBeforeFallback = 2;

class PrimalWork : public WorkSource {
 public:
  PrimalWork(const ComponentContext& context, std::unique_ptr<EffortAccount> account, int worker)
      : WorkSource(*account),
        context_(context),
        worker_(worker),
        account_(std::move(account)),
        stops_(context.stops),
        wanted_(kMaxShare) {
    // Counts the root in advance, because expanding it takes long if there are many pairs of
    // agents.
    const std::int64_t agents = context.problem.instance.agent_count();
    const std::int64_t root = kRootWorkPerPair * agents * agents;
    account_->earn(root, std::min(kMaxShare, max_primal_share(root, false, tuning())));
  }

  std::int64_t start_effort() const override { return kStartWork; }
  Claim claim() override {
    const PrimalSearch& primal = updated_search();
    return {.is_open = !primal.optimal(), .is_urgent = primal.expects_plan()};
  }
  Share share(std::int64_t lower_tier_effort) override;
  std::unique_ptr<WorkItem> next() override;
  bool pays() const override { return !search_->expects_plan(); }
  void add_counts(Counters& counters) const override;

 private:
  class Item;

  const Tuning& tuning() const { return context_.options.tuning; }
  PrimalSearch& updated_search();

  const ComponentContext& context_;
  const int worker_;
  const std::unique_ptr<EffortAccount> account_;
  AgentStopsCache stops_;
  std::unique_ptr<PrimalSearch> search_;  // made when first due
  double wanted_;                         // r before floor and cap

  mutable std::mutex counting_;
  PrimalSearch::Counts counts_;  // guarded by counting_
};

class PrimalWork::Item : public WorkItem {
 public:
  explicit Item(PrimalWork& work) : work_(work) {}

  std::string_view name() const override { return "primal search"; }
  void perform(Workspace&) override {
    PrimalSearch& search = *work_.search_;
    const std::int64_t before = search.work();
    plan_ = search.step(work_.context_.limits);
    set_effort(search.work() - before, 0);
  }
  void commit() override {
    const PrimalSearch& search = *work_.search_;
    {
      const std::lock_guard lock(work_.counting_);
      work_.counts_ = search.counts();
    }
    if (plan_) work_.context_.bounds.post(std::move(*plan_), search.source());
    work_.wanted_ =
        wanted_primal_share(search, work_.context_.problem.instance.agent_count(), work_.tuning());
  }
  bool is_long() const override { return true; }

 private:
  PrimalWork& work_;
  std::optional<Plan> plan_;
};

// Returns the primal search, updated with the incumbent and the latest dual solution.
PrimalSearch& PrimalWork::updated_search() {
  const SolveOptions& options = context_.options;
  if (!search_)
    search_ = std::make_unique<PrimalSearch>(context_.problem, stops_,
                                             options.seed + static_cast<std::uint64_t>(worker_),
                                             options.techniques, options.tuning);
  if (const auto plan = context_.bounds.plan_below(search_->best_cost().value_or(kInfiniteCost)))
    search_->adopt(*plan);
  if (techniques_of(options).has(Technique::kLagrangianLns))
    search_->use(context_.results.dual_solution());
  return *search_;
}

Share PrimalWork::share(std::int64_t lower_tier_effort) {
  const Cost lower_bound = context_.bounds.lower_bound();
  const Cost cutoff = context_.bounds.cutoff();
  const bool gap_is_large =
      cutoff<kInfiniteCost&& static_cast<double>(cutoff)>(1 + tuning().large_gap) *
      static_cast<double>(lower_bound);
  const bool is_dominated = context_.nodes.frontier.bound() < lower_bound;
  return {.wanted = wanted_,
          .floor = is_dominated || gap_is_large ? tuning().primal_min_share_dominated : 0,
          .cap = max_primal_share(lower_tier_effort, gap_is_large, tuning())};
}

std::unique_ptr<WorkItem> PrimalWork::next() {
  if (updated_search().optimal()) return nullptr;
  return std::make_unique<Item>(*this);
}

void PrimalWork::add_counts(Counters& counters) const {
  const std::lock_guard lock(counting_);
  counters[Counter::kPrimalSteps] += counts_.steps;
  counters[Counter::kPrimalAttempts] += counts_.attempts;
  counters[Counter::kPrimalLacamSteps] += counts_.joint_steps;
  counters[Counter::kPrimalLnsIterations] += counts_.neighborhoods;
  counters[Counter::kPrimalLowLevelCalls] += counts_.low_level_calls;
  counters[Counter::kPrimalLowLevelExpanded] += counts_.low_level_expanded;
}

class PrimalComponent : public Component {
 public:
  explicit PrimalComponent(const ComponentContext& context) : context_(context) {}

  EffortTier tier() const override { return EffortTier::kPrimal; }
  std::unique_ptr<WorkSource> source(int worker) override {
    return std::make_unique<PrimalWork>(
        context_, std::make_unique<EffortAccount>(EffortAccount::Terms{.cancels_debt = true}),
        worker);
  }

 private:
  const ComponentContext& context_;
};

}  // namespace

double wanted_primal_share(const PrimalSearch& primal, int agents, const Tuning& tuning) {
  if (!primal.best_cost())
    return primal.counts().attempts <= kFailedAttemptsBeforeFallback * agents
               ? kMaxShare
               : tuning.primal_share_after_failures;
  const double x =
      static_cast<double>(primal.work_at_last_plan()) / static_cast<double>(primal.work());
  return std::clamp(kMaxShare * x * x * x, kMinShare, kMaxShare);
}

double max_primal_share(std::int64_t tree_work, bool gap_is_large, const Tuning& tuning) {
  if (gap_is_large) return kMaxShare;
  const double part =
      static_cast<double>(tree_work) / static_cast<double>(tuning.primal_full_share_work);
  return std::clamp(kMaxShare * part, tuning.primal_max_share_initial, kMaxShare);
}

std::unique_ptr<Component> make_primal_component(const ComponentContext& context) {
  if (!techniques_of(context.options).has(Technique::kPrimal)) return nullptr;
  return std::make_unique<PrimalComponent>(context);
}

}  // namespace grove::detail
