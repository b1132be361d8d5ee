// SPDX-License-Identifier: MIT
#include "engine/worker.h"

namespace grove::detail {

Worker::Worker(Components& components, int number)
    : components_(components),
      workspace_(components.context()),
      scheduler_(components.sources(number), components.context().bounds) {}

std::unique_ptr<WorkItem> Worker::choose() {
  components_.keep_within_memory();
  return scheduler_.choose();
}

void Worker::commit(WorkItem& item) {
  item.commit();
  scheduler_.charge(item);
  components_.context().observer.worked();
}

Expander& Worker::OwnExpander::expander() {
  if (!expander_)
    expander_ = std::make_unique<Expander>(
        context_.problem, stops_, search_options_of(context_.options), context_.memory.cache(),
        make_agent_planner(context_.options.low_level, context_.problem.instance.world()));
  return *expander_;
}

}  // namespace grove::detail
