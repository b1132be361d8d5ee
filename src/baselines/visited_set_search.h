// SPDX-License-Identifier: MIT
// Low level of Optimal-CBS: A* over (cell, time, tasks visited).
#pragma once

#include <memory>
#include <vector>

#include "baselines/baseline_search.h"
#include "baselines/spanning_tree_bound.h"
#include "planning/bucket_queue.h"
#include "planning/safe_intervals.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

// The method is described at the head of visited_set_search.cpp.
class VisitedSetSearch : public BaselineSearch {
 public:
  // `world` must outlive this object.
  explicit VisitedSetSearch(const World& world) : world_(world), intervals_(world) {}

  std::int64_t expanded() const override { return expanded_; }

 private:
  PathOutcome search(const AgentStops& stops, const PathQuery& query, const Limits& limits,
                     Path& path) override;

  struct Label {
    StopSet left;
    Time time;
    Cell cell;
    std::int32_t parent;
  };

  void prepare(const AgentStops& stops, std::span<const Constraint> constraints);
  PathOutcome run(Time cutoff, const Limits& limits, Path& path);
  void reach(Cell cell, Time time, StopSet left, std::int32_t parent);
  Time min_cost(Cell cell, StopSet left);
  bool is_finish(const Label& label) const;
  void write_path(std::int32_t finish, Path& path) const;

  const World& world_;
  SafeIntervals intervals_;
  std::vector<std::unique_ptr<SpanningTreeBound>> bounds_;  // by AgentIndex
  BucketQueue queue_;
  std::int64_t expanded_ = 0;

  // State of the call in progress.
  const AgentStops* stops_ = nullptr;
  SpanningTreeBound* bound_ = nullptr;
  Time static_from_ = 0;
  StopSetIndex sets_;   // numbers of the sets `left` found so far
  StopSetIndex index_;  // index in labels_; the key combines number of the set, time and cell
  std::vector<Label> labels_;
};

}  // namespace grove::detail
