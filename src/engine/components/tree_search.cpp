// SPDX-License-Identifier: MIT
// Node selection, for the tolerance w (omega). With w = 0 the best node is always taken.
//
// With w > 0, a plan within w of the lower bound ends the run at once. Any node whose bound is
// within w of the lower bound can lead to such a plan. Among these nodes the one with the least
// bound is a poor choice, because it often has many conflicts. Therefore, as in explicit estimation
// search (Li, Ruml and Koenig, AAAI 2021), every second node is selected by the expected cost of a
// plan below it. The other nodes are selected best first and raise the bound.
//
// With an incumbent of cost C, selection is best first, as with w = 0. Every node with a bound
// below C / (1 + w) must be expanded, in any order. Expanding a node above that bound could only
// yield a better plan, which neighbourhood search usually finds sooner.
//
// A node is live, and counts in the lower bound, until all its children have been pushed or pruned.
#include "engine/components/tree_search.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/components.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr double kGoldenRatio = 0.6180339887;  // its multiples spread evenly over [0, 1)

// Work items of the tree search for one worker.
class TreeWork : public WorkSource {
 public:
  TreeWork(TreeSearch& search, const ComponentContext& context, EffortAccount& account, int worker)
      : WorkSource(account), search_(search), context_(context), worker_(worker) {}

  std::unique_ptr<WorkItem> next() override;
  bool pays() const override { return false; }
  void add_counts(Counters& counters) const override {
    const std::lock_guard lock(counting_);
    counters += counts_.reported;
    counters[Counter::kAssists] += helps_;
  }

 private:
  class Item;
  class Expand;
  class Help;

  TreeSearch& search_;
  const ComponentContext& context_;
  const int worker_;
  NodePtr helped_;  // last node with which there was nothing left to help

  mutable std::mutex counting_;  // guards the counts below
  ExpansionCounts counts_;
  std::int64_t helps_ = 0;
};

// An item that uses the expander.
class TreeWork::Item : public WorkItem {
 public:
  Item(TreeWork& work, NodePtr node)
      : work_(work), node_(std::move(node)), cache_(work.context_.memory.cache()) {}

  void publish() override { cache_->merge(std::exchange(found_, {})); }
  CacheDelta* new_results() override { return &found_; }

 protected:
  // Runs `what` with the expander, and records effort, counts and new results.
  template <class What>
  void run_and_measure(Expander& expander, const What& what) {
    expander.use_shared_cache(cache_);
    const std::int64_t work = expander.work();
    const double whole_work = expander.whole_work();
    const ExpansionCounts counts = expander.counts();
    what();
    set_effort(expander.work() - work, expander.whole_work() - whole_work);
    counts_ = expander.counts();
    counts_ -= counts;
    found_ = expander.take_delta();
  }
  void trim_and_count(std::int64_t helps) {
    cache_->trim();
    const std::lock_guard lock(work_.counting_);
    work_.counts_ += counts_;
    work_.helps_ += helps;
  }

  TreeWork& work_;
  const NodePtr node_;

 private:
  const std::shared_ptr<SharedCache> cache_;
  CacheDelta found_;
  ExpansionCounts counts_;
};

class TreeWork::Expand : public Item {
 public:
  Expand(TreeWork& work, NodePtr node)
      : Item(work, std::move(node)), bounding_effort_(work.search_.bounding_effort()) {}

  std::string_view name() const override { return "expand"; }
  void perform(Workspace& workspace) override {
    Expander& expander = workspace.expander();
    run_and_measure(expander, [&] {
      const ComponentContext& context = work_.context_;
      expansion_ =
          expander.expand(node_, context.bounds.cutoff(), context.limits, bounding_effort_);
    });
  }
  void commit() override {
    trim_and_count(0);
    work_.search_.finish(node_, std::move(expansion_), work_.worker_);
  }
  void abandon() override {
    expansion_ = {};
    expansion_.stopped = true;
  }
  bool allows_next() const override { return true; }

 private:
  const BoundingEffort bounding_effort_;
  Expansion expansion_;
};

class TreeWork::Help : public Item {
 public:
  using Item::Item;

  std::string_view name() const override { return "help"; }
  void perform(Workspace& workspace) override {
    const double share = work_.worker_ * kGoldenRatio - std::floor(work_.worker_ * kGoldenRatio);
    Expander& expander = workspace.expander();
    run_and_measure(expander, [&] {
      const ComponentContext& context = work_.context_;
      if (!expander.help(node_, context.bounds.cutoff(), share, context.limits))
        work_.helped_ = node_;
    });
  }
  void commit() override { trim_and_count(1); }
};

std::unique_ptr<WorkItem> TreeWork::next() {
  if (NodePtr node = search_.take()) return std::make_unique<Expand>(*this, std::move(node));
  if (NodePtr node = search_.unfinished(); node && node != helped_)
    return std::make_unique<Help>(*this, std::move(node));
  return nullptr;
}

}  // namespace

TreeSearch::TreeSearch(const ComponentContext& context)
    : context_(context),
      uses_estimates_(techniques_of(context.options).has(Technique::kEstimates)) {}

std::unique_ptr<WorkSource> TreeSearch::source(int worker) {
  return std::make_unique<TreeWork>(*this, context_, account_, worker);
}

bool TreeSearch::has_work() const {
  return context_.nodes.frontier.open() > 0;
}

NodePtr TreeSearch::take() {
  context_.trees.instantiate_due_tree();
  NodePtr node = take_open();
  if (node || context_.nodes.frontier.live() > 0) return node;
  context_.trees.refill_nodes();
  return take_open();
}

NodePtr TreeSearch::take_open() {
  NodePtr node;
  if (plan_is_wanted())
    node = context_.nodes.frontier.take_by_estimate(context_.options.omega,
                                                    context_.bounds.lower_bound(),
                                                    context_.options.tuning.cost_per_conflict);
  return node ? node : context_.nodes.frontier.take();
}

// True if the next node is to be selected by its expected plan cost.
bool TreeSearch::plan_is_wanted() {
  if (context_.options.omega == Omega() || context_.bounds.cutoff() < kInfiniteCost ||
      !uses_estimates_)
    return false;
  return ++estimates_turn_ % 2 != 0;
}

NodePtr TreeSearch::unfinished() const {
  const std::lock_guard lock(helping_);
  return unfinished_;
}

void TreeSearch::finish(const NodePtr& node, Expansion expansion, int worker) {
  {
    const std::lock_guard lock(helping_);
    if (expansion.unfinished)
      unfinished_ = node;
    else if (unfinished_ == node)
      unfinished_ = nullptr;
  }
  if (expansion.stopped || expansion.unfinished) {
    context_.nodes.frontier.reinsert(node);
    return;
  }
  ++context_.nodes.expanded;
  if (node->tree().number == 0) context_.results.set_first_tree(node->tree());
  context_.observer.expanded(node, expansion, worker);
  for (const NodePtr& child : expansion.children) {
    GROVE_CHECK(child->bound() >= node->bound(), "bounds do not fall from a node to its children");
    ++nodes_generated_;
    if (child->bound() < context_.bounds.cutoff()) context_.nodes.frontier.push(child);
  }
  if (expansion.plan) context_.bounds.post(std::move(*expansion.plan), PlanSource::kTree);
  context_.nodes.frontier.complete(node);
  context_.bounds.nodes_changed();
}

void TreeSearch::add_counts(Counters& counters) const {
  counters[Counter::kNodesExpanded] += context_.nodes.expanded;
  counters[Counter::kNodesGenerated] += nodes_generated_;
  counters[Counter::kNodesEvicted] += context_.memory.nodes_evicted();
}

void TreeSearch::add_memory(MemoryUse& memory) const {
  const MemoryUse held = context_.memory.memory_use();
  memory.nodes += held.nodes;
  memory.prices += held.prices;
  memory.path_sets += held.path_sets;
  memory.groups += held.groups;
}

std::unique_ptr<Component> make_tree_search(const ComponentContext& context) {
  return std::make_unique<TreeSearch>(context);
}

}  // namespace grove::detail
