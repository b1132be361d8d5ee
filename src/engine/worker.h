// SPDX-License-Identifier: MIT
// Worker of a run, which performs one work item after the other.
#pragma once

#include <memory>

#include "engine/components.h"
#include "engine/scheduler.h"
#include "search/expander.h"

namespace grove::detail {

// Performs work items of the components of the engine, which the scheduler of the worker chooses.
// One thread at a time, except where a function says otherwise.
class Worker {
 public:
  // `components` must outlive this object. `number`: number of the worker within the run, from 0.
  Worker(Components& components, int number);

  // Chooses and completes one work item. Returns false if none is available.
  bool turn() {
    const std::unique_ptr<WorkItem> item = choose();
    if (!item) return false;
    item->perform(workspace());
    item->publish();
    commit(*item);
    return true;
  }

  // The parts of turn() that belong to the worker. Several items with WorkItem::allows_next() can
  // be chosen before the first is committed. choose() returns nullptr if no item is available.
  std::unique_ptr<WorkItem> choose();
  void commit(WorkItem& item);
  // The objects for the worker's items. One thread at a time, which need not be the worker's.
  Workspace& workspace() { return workspace_; }

  // Adds the counts of all committed items. Any thread.
  void add_counts(Counters& counters) const { scheduler_.add_counts(counters); }

 private:
  // Makes the expander on first use.
  class OwnExpander : public Workspace {
   public:
    explicit OwnExpander(const ComponentContext& context)
        : context_(context), stops_(context.stops) {}
    Expander& expander() override;

   private:
    const ComponentContext& context_;
    AgentStopsCache stops_;
    std::unique_ptr<Expander> expander_;
  };

  Components& components_;
  OwnExpander workspace_;
  Scheduler scheduler_;
};

}  // namespace grove::detail
