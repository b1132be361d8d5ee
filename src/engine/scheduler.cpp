// SPDX-License-Identifier: MIT
// *Policy.* Each component has an account (effort_account.h). For each unit of effort that workers
// spend in lower tiers, the component earns
//
//   rate = min(cap, max(floor, wanted)).
//
// It pays for its own effort, except for an item after which pays() is false. A component is due if
// the effort of lower tiers has reached start_effort(), and
// - its claim is urgent, or
// - its claim is open and it has credit: earned >= spent.
//
// A worker asks the components that are due for a work item, the one registered last first. If none
// has an item, it asks all components that use idle time, the one registered first first. The tree
// search is registered first and is never due, so it gets all time that the others do not claim.
//
// | component   | tier   | start                     | wanted                   | floor | cap    |
// |-------------|--------|---------------------------|--------------------------|-------|--------|
// | tree        | tree   | never due                 |                          |       |        |
// | primal      | primal | kStartWork                | 8 x^3, at least 1/32 [a] | 0, 1  | 1/4..8 |
// | preparation | primal | never due                 |                          |       |        |
// | lagrangian  | bound  | lagrangian_start_work [b] | lagrangian_max_share [c] | 0     | wanted |
// | joint       | bound  | joint_start_work          | joint_max_share          | 0     | wanted |
// | cores       | bound  | cores_start_work          | ratio of efforts left    | [d]   | [d]    |
//
// The formulas of each component are at the head of its file in engine/components.
// [a] With a plan, where x = (effort at the component's last gain) / (its effort so far).
// [b] Ten times as much without a plan.
// [c] Times the number of ranks, on rank 0. On other ranks its claim is urgent after the first
//     request from rank 0.
// [d] k / 4; cores_max_share, before cores_early_work k (engine/components/cores.cpp).
#include "engine/scheduler.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"

namespace grove::detail {

Scheduler::Scheduler(std::vector<Entry> entries, const SharedBounds& bounds)
    : entries_(std::move(entries)), bounds_(bounds) {
  GROVE_CHECK(std::ranges::is_sorted(entries_, {}, &Entry::tier),
              "components are registered by ascending tier");
}

bool is_due(WorkSource& source) {
  if (source.account().lower_tier_effort() < source.start_effort()) return false;
  const Claim claim = source.claim();
  return claim.is_urgent || (claim.is_open && source.account().has_credit());
}

// Once the run is over, the lower tiers may still give out items, which are stopped or discarded;
// the callers choose no further ones.
std::unique_ptr<WorkItem> Scheduler::choose() {
  for (std::size_t i = entries_.size(); i-- > 0;) {
    const Entry& entry = entries_[i];
    if (!is_due(*entry.source) || (entry.tier == EffortTier::kBound && bounds_.over())) continue;
    if (auto item = item_of(i)) return item;
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    if (!entry.source->uses_idle_time() || (entry.tier > EffortTier::kTree && bounds_.over()))
      continue;
    if (auto item = item_of(i)) return item;
  }
  return nullptr;
}

std::unique_ptr<WorkItem> Scheduler::item_of(std::size_t entry) {
  auto item = entries_[entry].source->next();
  if (item) item->entry_ = entry;
  return item;
}

void Scheduler::charge(const WorkItem& item) {
  GROVE_CHECK(item.effort() >= 0, "the effort of an item is not negative");
  const Entry& own = entries_.at(item.entry_);
  if (own.source->pays()) own.source->account().spend(item.effort());
  for (const Entry& other : entries_) {
    if (other.tier <= own.tier) continue;
    EffortAccount& account = other.source->account();
    const double rate = rate_of(other.source->share(account.lower_tier_effort() + item.effort()));
    GROVE_CHECK(rate >= 0, "no component earns effort at a negative rate");
    account.earn(item.effort(), rate);
  }
}

void Scheduler::add_counts(Counters& counters) const {
  for (const Entry& entry : entries_) entry.source->add_counts(counters);
}

}  // namespace grove::detail
