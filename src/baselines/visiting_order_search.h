// SPDX-License-Identifier: MIT
// Middle level of HCBS and MGCBS: A* over visiting orders.
#pragma once

#include <memory>
#include <vector>

#include "baselines/baseline_search.h"
#include "baselines/legs.h"
#include "baselines/spanning_tree_bound.h"
#include "planning/bucket_queue.h"
#include "planning/safe_intervals.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

// The method is described at the head of visiting_order_search.cpp.
class VisitingOrderSearch : public BaselineSearch {
 public:
  // `world` must outlive this object.
  VisitingOrderSearch(const World& world, std::unique_ptr<Legs> legs);

  std::int64_t expanded() const override { return expanded_ + legs_->expanded(); }

 private:
  PathOutcome search(const AgentStops& stops, const PathQuery& query, const Limits& limits,
                     Path& path) override;

  struct Label {
    Time time = kNever;
    std::int32_t parent = kNoLabel;
  };
  using Entry = BucketQueue::Entry;
  static constexpr std::int32_t kNoLabel = -1;

  bool prepare(const AgentStops& stops, std::span<const Constraint> constraints);
  void add_targets(int goal, Cell cell);
  void start();
  PathOutcome run(Time cutoff, const Limits& limits, Path& path);
  void expand(std::int32_t id, const Limits& limits);
  void go_to(int goal, StopSet left, std::int32_t from, bool to_rest, const Limits& limits);
  bool is_finish(std::int32_t id) const;
  void write_path(std::int32_t finish, Path& path);

  // The number of a label combines a row (the set of stops left) and a column (the target that the
  // agent stands on). Column 0 is the start.
  std::int32_t row_of(StopSet left);
  StopSet left_of(std::int32_t id) const { return lefts_[id / columns()]; }
  int column_of(std::int32_t id) const { return id % columns(); }
  int columns() const { return static_cast<int>(targets_.size()); }
  Cell cell_of(int column) const {
    return column == 0 ? stops_->start() : intervals_.state_of(targets_[column].slot);
  }
  SpanningTreeBound& bound() { return *bounds_[stops_->agent()]; }

  SafeIntervals intervals_;
  std::unique_ptr<Legs> legs_;
  std::vector<std::unique_ptr<SpanningTreeBound>> bounds_;  // by AgentIndex
  BucketQueue queue_;
  std::int64_t expanded_ = 0;

  // State of the call in progress.
  const AgentStops* stops_ = nullptr;
  std::vector<Legs::Target> targets_;  // by column
  std::vector<int> first_target_;  // by goal: column of its first target; one more entry at the end
  StopSetIndex rows_;              // row by set of stops left
  std::vector<StopSet> lefts_;     // by row
  std::vector<Label> labels_;      // row by row
};

}  // namespace grove::detail
