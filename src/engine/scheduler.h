// SPDX-License-Identifier: MIT
// Divides the time of one worker between the components of the engine.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/component.h"

namespace grove::detail {

// Chooses the next work item. Counts effort (model/effort.h), not seconds, so that a run is
// repeatable. The policy is at the head of the .cpp. One thread at a time.
class Scheduler {
 public:
  struct Entry {
    EffortTier tier;
    std::unique_ptr<WorkSource> source;
  };

  // `entries`: in the order of registration, by ascending tier. `bounds` must outlive this object.
  Scheduler(std::vector<Entry> entries, const SharedBounds& bounds);

  // Returns the next work item; nullptr if there is none.
  std::unique_ptr<WorkItem> choose();
  // Must be called after each item's commit().
  void charge(const WorkItem& item);

  // Adds the counts of all sources. Any thread.
  void add_counts(Counters& counters) const;

 private:
  std::unique_ptr<WorkItem> item_of(std::size_t entry);

  const std::vector<Entry> entries_;
  const SharedBounds& bounds_;
};

// Returns true if the component is due. Tests the conditions in the order of the policy.
bool is_due(WorkSource& source);

// Effort that the component earns per unit of effort of lower tiers.
constexpr double rate_of(const Share& share) {
  return std::min(share.cap, std::max(share.floor, share.wanted));
}

}  // namespace grove::detail
