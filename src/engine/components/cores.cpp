// SPDX-License-Identifier: MIT
// The component that proves bounds by unsatisfiable cores (cores/core_search.h).
//
// *Share.* The tree search starts alone, because its first nodes solve most instances. After
// cores_start_work both share the effort, cores_max_share units per unit of other effort: it is not
// known in advance which of the two proves a bound sooner. A tree multiplies the nodes of
// independent groups of agents, cores add; in narrow maps the tree is ahead, because it reasons about
// corridors and groups.
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

class CoresWork : public WorkSource {
 public:
  CoresWork(const ComponentContext& context, EffortAccount& account)
      : WorkSource(account), context_(context) {}

  std::int64_t start() const override { return context_.options.tuning.cores_start_work; }
  Claim claim() override { return {.is_open = !over_}; }
  Share share(std::int64_t /*base*/) const override {
    const double most = context_.options.tuning.cores_max_share;
    return {.wanted = most, .cap = most};
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

  const ComponentContext& context_;
  bool over_ = false;
  std::unique_ptr<CoreSearch> search_;  // made when first due
  Cost proven_ = 0;                     // the greatest bound so far
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
  counts_.cores = search_->cores();
  counts_.sat_conflicts = search_->sat_conflicts();
  counts_.path_conflicts = search_->path_conflicts();
  GROVE_CHECK(progress.proven >= proven_, "the bound from cores never falls");
  proven_ = progress.proven;
  if (over_) search_.reset();  // frees memory for the tree search
  return progress;
}

class CoresComponent : public Component {
 public:
  explicit CoresComponent(const ComponentContext& context) : context_(context) {}

  Tier tier() const override { return Tier::kBound; }
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
