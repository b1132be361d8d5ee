// SPDX-License-Identifier: MIT
// Visit stages: progress of an agent that heads for its stops in a given order, but has also
// visited the stops that it passes earlier.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "planning/problem.h"
#include "sequencing/sequence.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

// Distance fields that guide agents instead of distances in steps.
struct LegFields {
  std::vector<DistanceView> to_task;  // by TaskIndex
  std::vector<DistanceView> to_rest;  // by AgentIndex; see DistanceFields::to_rest
};

// Numbers the sets of remaining stops of one agent as stages, which are created when first reached.
// One thread at a time.
class VisitStages {
 public:
  using Stage = std::int32_t;

  // `problem` and the fields of `guide` must outlive this object. `guide`: nullptr for distances in
  // steps. Throws std::invalid_argument if `order` is not a complete sequence.
  VisitStages(const Problem& problem, AgentIndex agent, Sequence order,
              const LegFields* guide = nullptr);

  // The stage of the agent at its start: all stops are left, except a stop at the start.
  Stage first() { return after(all_, start_); }
  // The stage that follows `stage` when the agent enters `state`.
  Stage after(Stage stage, State state) {
    const Place place = instance_.world().place(state);
    for (std::size_t stop = 0; stop < places_.size(); ++stop)
      if (places_[stop] == place && instance_.is_visited(stops()[stop], state))
        return after_stop(stage, static_cast<int>(stop));
    return stage;
  }
  // True if an agent in `stage` may enter `state`. It must not execute a task that it has completed
  // or that is not its own.
  bool may_enter(Stage stage, State state) const {
    const World& world = instance_.world();
    if (!world.is_working(state)) return true;
    const auto stop = std::ranges::find(stops(), world.work(state).task) - stops().begin();
    return stop < std::ssize(stops()) && (entries_[stage].left >> stop & 1) != 0;
  }

  // Distance from `state` through all remaining stops, in order, to the place of rest, in units of
  // the guide or in steps; at least kNever if there is no path.
  Time distance(Stage stage, State state) const {
    const Entry& entry = entries_[stage];
    return entry.to_next[state] + entry.onward;
  }

  // Uses distances in steps from now on, instead of the guide.
  void go_by_steps();

  // True if an agent in `stage` may rest in `state`.
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
    DistanceView to_next;  // to the first remaining stop or, without one, to the place of rest
    Time onward;           // from there through the other stops to rest; less than kNever
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
  Targets guide_targets_;  // fields of the guide, or a copy of steps_
  Stage all_;
  std::vector<Entry> entries_;
  StopSetIndex index_;
};

}  // namespace grove::detail
