// SPDX-License-Identifier: MIT
// Visit stages: an agent that heads for its stops in a given order and also counts stops met
// earlier.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "search/problem.h"
#include "sequencing/sequence.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

// Distance fields that guide agents in place of distances in steps.
struct LegFields {
  std::vector<DistanceView> to_task;  // by TaskIndex
  std::vector<DistanceView> to_rest;  // by AgentIndex, as DistanceFields::to_rest
};

// The sets of stops left of one agent, as numbered stages that are created when first met. One
// thread at a time.
class VisitStages {
 public:
  using Stage = std::int32_t;

  // `problem` and the fields of `guide` must outlive this. `guide` == nullptr: distances in steps.
  // Throws std::invalid_argument if `order` is not a complete sequence.
  VisitStages(const Problem& problem, AgentIndex agent, Sequence order,
              const LegFields* guide = nullptr);

  // The first stage: all stops are left except one at the start.
  Stage first() { return after(all_, start_); }
  // The stage of an agent of `stage` once it is in `state`.
  Stage after(Stage stage, State state) {
    const Place place = instance_.world().place(state);
    for (std::size_t stop = 0; stop < places_.size(); ++stop)
      if (places_[stop] == place && instance_.is_visited(stops()[stop], state))
        return after_stop(stage, static_cast<int>(stop));
    return stage;
  }
  // May an agent of this stage enter the state? It may not work on a task that it has completed or
  // that is not its own.
  bool may_enter(Stage stage, State state) const {
    const World& world = instance_.world();
    if (!world.is_working(state)) return true;
    const auto stop = std::ranges::find(stops(), world.work(state).task) - stops().begin();
    return stop < std::ssize(stops()) && (entries_[stage].left >> stop & 1) != 0;
  }

  // Distance from `state` through all stops left, in order, to the place of rest, by the guide or
  // in steps; kNever or more if there is no path.
  Time distance(Stage stage, State state) const {
    const Entry& entry = entries_[stage];
    return entry.to_next[state] + entry.onward;
  }

  // Replaces the guide by distances in steps.
  void go_by_steps();

  // May an agent of this stage rest in `state`?
  bool may_rest(Stage stage, State state) const {
    return entries_[stage].left == 0 && instance_.may_rest(agent_, state);
  }

 private:
  // Distance fields to all targets.
  struct Targets {
    std::vector<DistanceView> to_stop;
    DistanceView to_rest;
  };
  struct Entry {
    StopSet left;
    DistanceView to_next;  // to the first stop left, or to the place of rest
    Time onward;           // from there through all others; less than kNever
  };

  Stage after_stop(Stage stage, int stop) {
    const StopSet left = entries_[stage].left & ~(StopSet{1} << stop);
    if (left == entries_[stage].left) return stage;
    const std::uint32_t known = index_.find(left);
    return known != StopSetIndex::kAbsent ? static_cast<Stage>(known) : make(left);
  }
  Stage make(StopSet left);
  Entry entry(StopSet left) const;

  const std::vector<TaskIndex>& stops() const { return instance_.agent(agent_).stops; }

  const Instance& instance_;
  AgentIndex agent_;
  State start_;
  std::vector<Place> places_;  // by stop
  Sequence order_;
  Targets steps_;
  Targets guide_targets_;  // by the guide, or as steps_
  Stage all_;
  std::vector<Entry> entries_;
  StopSetIndex index_;
};

}  // namespace grove::detail
