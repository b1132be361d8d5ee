// SPDX-License-Identifier: MIT
// What an agent must visit when the low level chooses the order itself, within a sequence class.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "grove/model/assert.h"
#include "grove/model/distance_field.h"
#include "grove/model/instance.h"
#include "grove/model/plan.h"
#include "grove/sequencing/completions.h"
#include "grove/sequencing/rtsp.h"
#include "grove/sequencing/sequence_dag.h"

namespace grove {

// One agent's stops, with all that does not depend on the class: shared by its FreeGoals. Copies
// share what does not change; a copy may go to another thread.
class AgentStops {
 public:
  static constexpr int kNoStop = -1;

  // `instance` and `distances` must outlive this. Throws std::invalid_argument for an agent without
  // a destination and without a task.
  AgentStops(const Instance& instance, const DistanceFields& distances, AgentIndex agent);

  AgentIndex agent() const { return agent_; }
  int count() const { return static_cast<int>(cells_.size()); }
  Cell start() const { return start_; }
  std::optional<Cell> destination() const { return destination_; }
  Cell cell(int stop) const { return cells_[stop]; }
  // The stop on this cell; kNoStop: none.
  int stop_at(Cell cell) const { return (*stop_at_)[cell]; }
  StopSet all() const { return all_stops(count()); }

  // From a cell to each stop: count() distances in a row.
  const Time* distances_from(Cell cell) const {
    return distances_->data() + static_cast<std::size_t>(cell) * cells_.size();
  }
  // From a cell to the destination, which there must be.
  Time to_destination(Cell cell) const { return (*to_destination_)[cell]; }

  const Completions& completions() const { return completions_; }
  Completions& completions() { return completions_; }

 private:
  AgentIndex agent_;
  Cell start_;
  std::optional<Cell> destination_;
  std::vector<Cell> cells_;
  std::shared_ptr<const std::vector<std::int8_t>> stop_at_;  // by cell
  std::shared_ptr<const std::vector<Time>> distances_;       // by cell, then stop
  const DistanceField* to_destination_ = nullptr;
  Completions completions_;
};

// The states of one agent under one sequence class, numbered as the search comes upon them. A
// path *realizes* a sequence if it is on its stops one after the other and, without a destination,
// rests on the last one. For one thread; several FreeGoals may share their AgentStops within it.
class FreeGoals {
 public:
  using StateId = std::int32_t;
  static constexpr StateId kOutside = -1;

  struct State {
    StopSet left = 0;          // not counted yet
    StopSet next = 0;          // those of them that may be counted next
    StopSet rests = 0;         // without a destination: where the agent may come to rest
    bool may_skip = false;     // of the next: touching need not count
    std::int32_t first = 0;    // its onward ways, in onward()
    std::int32_t nearest = 0;  // so many of them settle the distance
    std::int32_t count = 0;
  };
  // A stop that may come next, and the least cost from there through all that is then left.
  struct Onward {
    std::int32_t stop;
    Time cost;
  };

  // `stops` must outlive this. Throws std::invalid_argument for a prefix that repeats a stop or
  // names one that the agent does not have.
  FreeGoals(AgentStops& stops, SequenceClass work);
  // The same with other completions than those of `stops`, over as many stops. They must outlive
  // this.
  FreeGoals(AgentStops& stops, SequenceClass work, Completions& completions);

  AgentStops& stops() { return stops_; }
  const AgentStops& stops() const { return stops_; }
  const SequenceClass& sequence_class() const { return class_; }
  const Completions& completions() const { return *completions_; }
  Completions& completions() { return *completions_; }

  // False if the class is empty or something in it cannot be reached at all.
  bool plausible() const;

  // The first state: nothing counted. Forgets all states if the completions were widened since;
  // to be called before each search.
  // kOutside if the completions know no member of the class.
  StateId first_state();
  const State& state(StateId id) const { return states_[id]; }
  int state_count() const { return static_cast<int>(states_.size()); }

  // The state after counting `stop`, which must be one of the next. kOutside if the completions do
  // not know it.
  StateId after(StateId id, int stop) {
    GROVE_ASSERT(states_[id].next >> stop & 1, "a stop that is counted may be next");
    const StateId known = after_[static_cast<std::size_t>(id) * stride_ + stop];
    return known == kUnknown ? make_after(id, stop) : known;
  }

  // Is there a stop on `cell` that may be counted next?
  bool may_count(StateId id, Cell cell) const {
    const int stop = stops_.stop_at(cell);
    return stop != AgentStops::kNoStop && (states_[id].next >> stop & 1) != 0;
  }
  // Calls reach(state) for each state that an agent in state `id` may be in once it has come to
  // `cell`. False: there is another one, which the completions do not know.
  template <class Reach>
  bool on_arrival(StateId id, Cell cell, Reach reach) {
    if (!may_count(id, cell)) {
      reach(id);
      return true;
    }
    if (states_[id].may_skip) reach(id);
    const StateId then = after(id, stops_.stop_at(cell));
    if (then == kOutside) return false;
    reach(then);
    return true;
  }

  // The least cost from a cell through all that is left, over the ways known; kNever or more when
  // there is none.
  Time distance(StateId id, Cell cell) const {
    const State& s = states_[id];
    if (s.left == 0) return to_rest(s, cell);
    const Time* to_stop = stops_.distances_from(cell);
    Time best = kNever;
    for (const Onward& o : std::span(&onward_[s.first], static_cast<std::size_t>(s.nearest)))
      best = std::min(best, to_stop[o.stop] + o.cost);
    return best;
  }
  // All ways known from a state; the first State::nearest of them settle distance().
  std::span<const Onward> onward(const State& state) const {
    return {onward_.data() + state.first, static_cast<std::size_t>(state.count)};
  }

  // May the agent come to rest here?
  bool is_rest(const State& state, Cell cell) const {
    if (state.left != 0) return false;
    if (stops_.destination()) return cell == *stops_.destination();
    const int stop = stops_.stop_at(cell);
    return stop != AgentStops::kNoStop && (state.rests >> stop & 1) != 0;
  }

 private:
  static constexpr StateId kUnknown = -2;

  Time to_rest(const State& state, Cell cell) const;
  StopSet next_of(StopSet left) const;
  StopSet rests_after(const State& state, int stop) const;
  Time onward_cost(StopSet left, int stop) const;
  StateId make_after(StateId id, int stop);
  StateId make_state(StopSet left, StopSet rests);
  void add_onward(State& state);

  AgentStops& stops_;
  Completions* completions_;
  SequenceClass class_;
  StopSet free_;            // the stops that are not in the prefix
  StopSet first_free_;      // those of them that may be the first
  bool rest_is_not_first_;  // without a destination: see the .cpp
  std::size_t stride_;      // of after_
  Time built_beyond_ = -1;  // completions().beyond() when the states were made
  StateId first_state_ = kOutside;
  std::vector<State> states_;
  std::vector<StateId> after_;  // by state, then stop
  std::vector<Onward> onward_;
  std::vector<StopSetIndex> index_;  // states by what is left; [1 + s]: that may not rest on s
};

// The sequence of the class that a path realizes: each stop counted as early as may be, without a
// destination the one it rests on last. Throws std::invalid_argument if it realizes none.
Sequence realized_sequence(const FreeGoals& goals, const Path& path);

}  // namespace grove
