// SPDX-License-Identifier: MIT
// One agent that heads for its stops in a given order and counts those it meets before.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "search/problem.h"
#include "sequencing/sequence.h"
#include "sequencing/sequence_dag.h"

namespace grove::detail {

// By which agents find their ways, instead of by the distances in steps.
struct LegFields {
  std::vector<DistanceView> to_task;  // by TaskIndex
  std::vector<DistanceView> to_rest;  // by AgentIndex, as DistanceFields::to_rest
};

// What an agent has still to visit, as numbered stages, made when first met. For one thread.
class VisitStages {
 public:
  using Stage = std::int32_t;

  // `problem` must outlive this, and the fields of `guide`; null: steps. Throws
  // std::invalid_argument if `order` is no complete sequence.
  VisitStages(const Problem& problem, AgentIndex agent, Sequence order,
              const LegFields* guide = nullptr);

  // Everything is left but what is on the start.
  Stage first() { return after(all_, start_); }
  // The stage of an agent of `stage` once it is in `state`.
  Stage after(Stage stage, State state) {
    const Place place = instance_.world().place(state);
    for (std::size_t stop = 0; stop < places_.size(); ++stop)
      if (places_[stop] == place && instance_.is_visited(stops()[stop], state))
        return after_stop(stage, static_cast<int>(stop));
    return stage;
  }
  // May an agent of this stage go there? Not to work on what is done or not its own.
  bool may_enter(Stage stage, State state) const {
    const World& world = instance_.world();
    if (!world.is_working(state)) return true;
    const auto stop = std::ranges::find(stops(), world.work(state).task) - stops().begin();
    return stop < std::ssize(stops()) && (entries_[stage].left >> stop & 1) != 0;
  }

  // From `state` through all that is left, in order, to where it is to rest, by the guide or in
  // steps; kNever or more when there is no way.
  Time distance(Stage stage, State state) const {
    const Entry& entry = entries_[stage];
    return entry.to_next[state] + entry.onward;
  }

  // From now on there is no guide.
  void go_by_steps();

  // May an agent of this stage rest in `state`?
  bool may_rest(Stage stage, State state) const {
    return entries_[stage].left == 0 && instance_.may_rest(agent_, state);
  }

 private:
  // Where there is to go.
  struct Targets {
    std::vector<DistanceView> to_stop;
    DistanceView to_rest;
  };
  struct Entry {
    StopSet left;
    DistanceView to_next;  // the first stop left; the place to rest if none is
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
  Targets repair_operators_;  // by the guide, or as steps_
  Stage all_;
  std::vector<Entry> entries_;
  StopSetIndex index_;
};

}  // namespace grove::detail
