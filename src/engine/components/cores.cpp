// SPDX-License-Identifier: MIT
// The component that proves bounds by unsatisfiable cores (cores/core_search.h).
//
// *Share.* It is not known in advance whether tree search or cores prove a bound sooner. In a tree,
// the numbers of nodes for independent groups of agents multiply; with cores, the efforts for the
// groups add up. In narrow maps the tree search is often faster, because it reasons about corridors
// and groups. The tree search starts alone, because its first nodes solve most instances. After
// cores_start_work the cores get, per unit of other effort,
//
//   k (g_t / r_t) / (g_c / r_c)   once they have a bound
//   k (g_t / r_t) / (4 e_t)       before, where e_t is the other effort so far
//
// within k / 4 .. cores_max_share, but at most k until the cores have done cores_early_work, so
// that an instance that the tree search soon solves is not delayed by much. g is the gap between
// the cost of the incumbent and a bound (t: of the tree search and the other components; c: of the
// cores), and r is the rate at which the bound has risen over about the latter half of the effort,
// so g / r estimates the effort that is left. Without an incumbent the share is k. k is
// cores_share_with_tasks if agents have tasks and turn freely: their graphs are large, so the
// solver is slow. Otherwise k is cores_share. If agents need time to turn, the tree search is slow
// as well: of 45 instances (20 agents, 10 to 50 tasks, 10 s), 26 are solved with k = cores_share,
// 22 with cores_share_with_tasks.
//
// *Measured*, by simulation from the bounds over time of either search alone, on 88 instances of
// seven maps: if the tree search alone proves the optimum, it takes 0.95 of its effort in the
// geometric mean for agents without tasks (2.1 at most), and 1.05 for agents with tasks (1.24;
// with k = 0.15, and with fixed rates of effort for the SAT solver). For the current values see
// tunables.def.
//
// *Statements about groups.* "These agents together cost at least k more than individually" holds
// at the root of the only tree, where no agent has a constraint. Both searches prove such
// statements. The tree search keeps them in its cache, where they raise the bounds of all nodes at
// which none of these agents has a constraint; in a distributed run they are sent to the other
// ranks. They are exchanged in commit(), at the same point of every deterministic run.
//
// *Ranks.* Each rank searches in another order of the agents, so that they find different cores.
//
// *Threads.* It is one sequential search, which one worker performs: worker 0 if there is one
// thread or the run is deterministic, else worker 1. With T threads, that worker alone cannot give
// w units per unit of effort of all T workers if w is large. It gives the part f = min(1, T w / (1
// + w)) of its time, i.e. f / (1 - f) units per unit of its own other effort.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/components.h"
#include "model/assert.h"
#ifdef GROVE_WITH_CADICAL
#include "cores/core_search.h"
#include "search/root_excesses.h"

namespace grove::detail {
namespace {

constexpr double kMaxPart = 0.99;  // of a worker's time
constexpr double kLeastRate = 1e-12;

constexpr std::size_t kMaxCoresBytes = std::size_t{4} << 30;

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

double base_share(const ComponentContext& context) {
  const Instance& instance = context.problem.instance;
  const Tuning& tuning = context.options.tuning;
  bool has_tasks = false;
  for (AgentIndex index = 0; index < instance.agent_count(); ++index) {
    const Agent& agent = instance.agent(index);
    if (agent.motion.turn_steps > 0) return tuning.cores_share;
    has_tasks = has_tasks || !agent.tasks.empty();
  }
  return has_tasks ? tuning.cores_share_with_tasks : tuning.cores_share;
}

class CoresWork : public WorkSource {
 public:
  CoresWork(const ComponentContext& context, EffortAccount& account)
      : WorkSource(account), context_(context), base_share_(base_share(context)) {}

  std::int64_t start_effort() const override { return context_.options.tuning.cores_start_work; }
  Claim claim() override { return {.is_open = !over_}; }
  Share share(std::int64_t lower_tier_effort) override;
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
  bool record(const GroupExcess& statement);
  void exchange_excesses();
  double wanted(std::int64_t lower_tier_effort);

  const ComponentContext& context_;
  const double base_share_;
  bool over_ = false;
  std::unique_ptr<CoreSearch> search_;  // made when first due
  Cost proven_ = 0;                     // the greatest bound so far
  std::atomic<std::int64_t> work_{0};
  Cost others_bound_ = 0;
  RiseRate others_rate_;
  RiseRate rate_;
  std::int64_t read_at_ = 0;  // effort at which the statements of the tree search were read
  std::map<std::vector<AgentIndex>, Cost> recorded_;  // statements of either search, by group
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
    ProofLog* const proof = work_.context_.options.proof;
    if (proof != nullptr && progress_.proven > bounds.lower_bound())
      proof->formula_bound(progress_.proven);
    bounds.prove(progress_.proven, ComponentId::kCores);
    work_.exchange_excesses();
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
    search_ = std::make_unique<CoreSearch>(
        context_.problem, context_.stops, techniques_of(context_.options),
        at_most_a_quarter(kMaxCoresBytes, context_.limits), context_.limits, context_.options.proof,
        static_cast<std::uint64_t>(context_.rank));
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

// Records a statement. Returns false if at least this excess of the group was recorded before.
bool CoresWork::record(const GroupExcess& statement) {
  Cost& excess = recorded_[statement.agents];
  if (statement.excess <= excess) return false;
  excess = statement.excess;
  return true;
}

// Reads the statements of the tree search when its effort has doubled. With a proof nothing is
// exchanged, because a formula cannot use lemmas, and trees cannot use cores.
void CoresWork::exchange_excesses() {
  if (context_.options.proof != nullptr) return;
  const Tree* const tree = context_.results.first_tree();
  if (!search_ || !search_->is_set_up() || tree == nullptr) return;
  std::vector<GroupExcess> found = search_->take_excesses();
  const bool is_due = work_ >= 2 * read_at_;
  if (found.empty() && !is_due) return;
  const std::shared_ptr<SharedCache> cache = context_.memory.cache();
  RootExcesses at_root(*cache, *tree);
  at_root.add(found);
  for (const GroupExcess& excess : found) record(excess);
  if (!is_due) return;
  read_at_ = work_;
  for (const GroupExcess& excess : at_root.all())
    if (record(excess)) search_->add(excess);
}

Share CoresWork::share(std::int64_t lower_tier_effort) {
  const Tuning& tuning = context_.options.tuning;
  const bool is_early = work_ < tuning.cores_early_work;
  const double most = is_early ? base_share_ : tuning.cores_max_share;
  const double least = std::min(base_share_ / 4, most);
  const double of_run = std::clamp(wanted(lower_tier_effort), least, most);
  const int threads = context_.options.deterministic ? 1 : context_.options.threads;
  const double part = std::min(kMaxPart, threads * of_run / (1 + of_run));
  const double own = threads == 1 ? of_run : part / (1 - part);
  return {.wanted = own, .cap = own};
}

double CoresWork::wanted(std::int64_t lower_tier_effort) {
  const Cost cutoff = context_.bounds.cutoff();
  const Cost bound = context_.bounds.lower_bound();
  const Frontier& frontier = context_.nodes.frontier;
  if (bound > proven_)
    others_bound_ = bound;
  else if (frontier.live() > 0)
    others_bound_ = std::max(others_bound_, std::min(bound, frontier.bound()));
  others_rate_.update(lower_tier_effort, others_bound_);
  rate_.update(work_, proven_);
  if (cutoff >= kInfiniteCost) return base_share_;
  const double others_left =
      static_cast<double>(cutoff - others_bound_) / std::max(others_rate_.rate(), kLeastRate);
  if (proven_ == 0)
    return base_share_ * others_left / (4 * static_cast<double>(lower_tier_effort + 1));
  const double left = static_cast<double>(cutoff - proven_) / std::max(rate_.rate(), kLeastRate);
  return base_share_ * others_left / std::max(left, 1.0);
}

class CoresComponent : public Component {
 public:
  explicit CoresComponent(const ComponentContext& context) : context_(context) {}

  EffortTier tier() const override { return EffortTier::kBound; }
  std::unique_ptr<WorkSource> source(int worker) override {
    const bool is_alone = context_.options.deterministic || context_.options.threads == 1;
    if (worker != (is_alone ? 0 : 1)) return nullptr;
    return std::make_unique<CoresWork>(context_, account_);
  }

 private:
  const ComponentContext& context_;
  EffortAccount account_;
};

}  // namespace

std::unique_ptr<Component> make_cores_component(const ComponentContext& context) {
  if (!techniques_of(context.options).has(Technique::kCores)) return nullptr;
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
