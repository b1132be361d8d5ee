// SPDX-License-Identifier: MIT
// The component that proves bounds by unsatisfiable cores (cores/core_search.h).
//
// *Share.* It is not known in advance whether tree search or cores prove a bound sooner: a tree
// multiplies the nodes of independent groups of agents, cores add; in narrow maps the tree is ahead,
// because it reasons about corridors and groups. The tree search starts alone, because its first
// nodes solve most instances. After cores_start_work the cores get, per unit of other effort,
//
//   cores_max_share                      if their bound is the global bound
//   (g_t / r_t) / (g_c / r_c)            otherwise, within cores_min_share .. cores_max_share
//
// where g is the gap between the cost of the incumbent and a bound (global: t, cores: c), and r is
// the rate at which the bound has risen over about the latter half of the effort. g / r estimates
// the effort that is left until the gap is closed. Without an incumbent the share is 1.
//
// It is one sequential search; only worker 0 of the run performs it.
#include <algorithm>
#include <atomic>
#include <cstddef>

#include "engine/components.h"
#include "model/assert.h"
#ifdef GROVE_WITH_CADICAL
#include "cores/core_search.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxCoresBytes = std::size_t{4} << 30;

std::size_t max_cores_bytes(const Limits& limits) {
  const auto limit = limits.memory_limit();
  return limit ? std::min(kMaxCoresBytes, *limit / 4) : kMaxCoresBytes;
}

// Rate at which a bound has risen per unit of effort, over the latter half to three quarters of the
// effort.
class RiseRate {
 public:
  void update(std::int64_t effort, Cost bound) {
    if (effort >= 2 * mid_.effort) {
      first_ = mid_;
      mid_ = {effort, bound};
    }
    now_ = {effort, bound};
  }
  double rate() const {
    const auto effort = static_cast<double>(now_.effort - first_.effort);
    return static_cast<double>(now_.bound - first_.bound) / std::max(effort, 1.0);
  }

 private:
  struct Point {
    std::int64_t effort = 0;
    Cost bound = 0;
  };
  Point first_, mid_, now_;
};

class CoresWork : public WorkSource {
 public:
  CoresWork(const ComponentContext& context, EffortAccount& account)
      : WorkSource(account), context_(context) {}

  std::int64_t start_effort() const override { return context_.options.tuning.cores_start_work; }
  Claim claim() override { return {.is_open = !over_}; }
  Share share(std::int64_t lower_tier_effort) const override {
    const Tuning& tuning = context_.options.tuning;
    return {.wanted = wanted(lower_tier_effort), .floor = tuning.cores_min_share, .cap = tuning.cores_max_share};
  }
  bool uses_idle_time() const override { return false; }
  std::unique_ptr<WorkItem> next() override;

  void add_counts(Counters& counters) const override {
    counters[Counter::kCores] += counts_.cores;
    counters[Counter::kCoresConflicts] += counts_.sat_conflicts;
    counters[Counter::kCoresPathConflicts] += counts_.path_conflicts;
  }

 private:
  class Item;

  struct Counts {
    std::atomic<std::int64_t> cores{0};
    std::atomic<std::int64_t> sat_conflicts{0};
    std::atomic<std::int64_t> path_conflicts{0};
  };
  // Results of one step of the search.
  struct Progress {
    Cost proven = 0;  // in the sense of SharedBounds::prove(); 0: nothing
    std::optional<Plan> plan;
    std::int64_t work = 0;
  };
  Progress run();
  double wanted(std::int64_t lower_tier_effort) const;

  const ComponentContext& context_;
  bool over_ = false;
  std::unique_ptr<CoreSearch> search_;  // made when first due
  Cost proven_ = 0;                     // the greatest bound so far
  std::atomic<std::int64_t> work_{0};
  mutable RiseRate others_rate_;
  mutable RiseRate rate_;
  Counts counts_;
};

class CoresWork::Item : public WorkItem {
 public:
  explicit Item(CoresWork& work) : work_(work) {}

  std::string_view name() const override { return "cores"; }
  void perform(Workspace&) override {
    progress_ = work_.run();
    set_effort(progress_.work, static_cast<double>(progress_.work));
  }
  void commit() override {
    SharedBounds& bounds = work_.context_.bounds;
    if (progress_.plan) bounds.post(std::move(*progress_.plan), PlanSource::kCores);
    bounds.prove(progress_.proven, ComponentId::kCores);
  }

 private:
  CoresWork& work_;
  Progress progress_;
};

std::unique_ptr<WorkItem> CoresWork::next() {
  return std::make_unique<Item>(*this);
}

CoresWork::Progress CoresWork::run() {
  if (!search_)
    search_ = std::make_unique<CoreSearch>(context_.problem, context_.stops,
                                           techniques_of(context_.options),
                                           max_cores_bytes(context_.limits), context_.limits);
  const std::int64_t before = search_->work();
  over_ = search_->step(context_.bounds.cutoff()) != CoreSearch::Outcome::kWorking;
  Progress progress{search_->lower_bound(), search_->plan(), search_->work() - before};
  work_ = search_->work();
  counts_.cores = search_->cores();
  counts_.sat_conflicts = search_->sat_conflicts();
  counts_.path_conflicts = search_->path_conflicts();
  GROVE_CHECK(progress.proven >= proven_, "the bound from cores never falls");
  proven_ = progress.proven;
  if (over_) search_.reset();  // frees memory for the tree search
  return progress;
}

double CoresWork::wanted(std::int64_t lower_tier_effort) const {
  const Cost cutoff = context_.bounds.cutoff();
  const Cost bound = context_.bounds.lower_bound();
  others_rate_.update(lower_tier_effort, bound);
  rate_.update(work_, proven_);
  if (proven_ >= bound) return context_.options.tuning.cores_max_share;
  if (cutoff >= kInfiniteCost || proven_ == 0) return 1;
  const double others_gap = static_cast<double>(cutoff - bound);
  const double gap = static_cast<double>(cutoff - proven_);
  return others_gap * rate_.rate() / std::max(gap * others_rate_.rate(), 1e-12);
}

class CoresComponent : public Component {
 public:
  explicit CoresComponent(const ComponentContext& context) : context_(context) {}

  EffortTier tier() const override { return EffortTier::kBound; }
  std::unique_ptr<WorkSource> source(int worker) override {
    return worker == 0 ? std::make_unique<CoresWork>(context_, account_) : nullptr;
  }

 private:
  const ComponentContext& context_;
  EffortAccount account_;
};

}  // namespace

// Certificates cannot contain cores yet.
std::unique_ptr<Component> make_cores_component(const ComponentContext& context) {
  if (!techniques_of(context.options).has(Technique::kCores) || context.options.proof != nullptr)
    return nullptr;
  return std::make_unique<CoresComponent>(context);
}

}  // namespace grove::detail
#else
namespace grove::detail {

std::unique_ptr<Component> make_cores_component(const ComponentContext&) {
  return nullptr;
}

}  // namespace grove::detail
#endif
