// SPDX-License-Identifier: MIT
// World: the graph on which agents move. It has places, which agents block; states on these places;
// and moves between states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/assert.h"

namespace grove::detail {

// The number of a place, which at most one agent occupies at a time, for example a cell of a grid.
// A number has a meaning only in its world.
using Place = std::int32_t;
inline constexpr Place kNoPlace = -1;

// The number of a state, a vertex of an agent's motion graph: a place, in some worlds with a
// heading or with the progress of a task execution. A number has a meaning only in its world.
using State = std::int32_t;
inline constexpr State kNoState = -1;

// A discrete time, or a duration, in steps.
using Time = std::int32_t;
// Infinite time, which is later than every time in a plan. Adding a duration below 2^30 to it does
// not overflow.
inline constexpr Time kNever = 1 << 30;

using TaskIndex = std::int32_t;  // position in Instance::tasks()

// Rows of numbers in compressed sparse row (CSR) format: one array contains all rows.
class CsrArray {
 public:
  // add() appends to the last row; end_row() completes that row.
  void add(std::int32_t item) { items_.push_back(item); }
  void end_row() { first_.push_back(static_cast<std::int32_t>(items_.size())); }

  std::int32_t count() const { return static_cast<std::int32_t>(first_.size()) - 1; }
  std::span<const std::int32_t> operator[](std::int32_t row) const {
    return {items_.data() + first_[row], items_.data() + first_[row + 1]};
  }
  std::span<const std::int32_t> items() const { return items_; }

 private:
  std::vector<std::int32_t> first_{0};  // by row: its offset; then the end of the last row
  std::vector<std::int32_t> items_;
};

// The states `first`, ..., `end` - 1.
struct StateRange {
  State first = 0;
  State end = 0;
};

// Progress of a task execution: `done` of the task's steps are done. `completed` is true if these
// are all of its steps.
struct Work {
  TaskIndex task = -1;
  Time done = 0;
  bool completed = false;
  State base = kNoState;  // the base state in which the agent works
};

// The states at work of a world, numbered after its base states.
class WorkingStates {
 public:
  // No states at work; the base states are 0, ..., `bases` - 1.
  explicit WorkingStates(State bases) : first_(bases) {}
  // The states `first`, `first` + 1, ..., one for each entry of `work`. `place_of` has one entry
  // for each of them, too. Each of the `places` places has `bases_on_a_place` base states.
  WorkingStates(State first, std::vector<Work> work, std::span<const Place> place_of, Place places,
                int bases_on_a_place);

  bool has(State state) const { return state >= first_; }
  // Precondition of work() and rank_on_place(): has(state).
  const Work& work(State state) const {
    GROVE_ASSERT(has(state), "only a state at work belongs to a task execution");
    return work_[state - first_];
  }
  std::int32_t rank_on_place(State state) const { return rank_[state - first_]; }
  // The states at work on `place`, ascending. Precondition: not every state is equal to its place.
  std::span<const State> on(Place place) const { return on_place_[place]; }
  int max_on_a_place() const;

 private:
  State first_;
  CsrArray on_place_;               // by place; empty if every state is equal to its place
  std::vector<Work> work_;          // by state, from first_ on
  std::vector<std::int32_t> rank_;  // by state, from first_ on
};

// The motion graph of an instance: places, states on these places, and moves between states. A move
// takes one step. An agent may wait in every state; a wait is not a move (docs/design.md, section
// 1).
// Each state belongs to a *kind*, one for each way to move. No move leads from one kind to another.
// Kind 0 is for agents that turn freely: its base states are 0, ..., place_count() - 1, and each is
// equal to its place. Grids and roadmaps have no other states. The states of agents at work are
// numbered after the *base* states of all kinds (motion_world.h).
// Immutable: any thread may read it.
class World {
 public:
  World(const World&) = default;
  World(World&&) = default;
  World& operator=(const World&) = default;
  World& operator=(World&&) = default;
  virtual ~World() = default;

  // Places are numbered 0, ..., place_count() - 1, and states 0, ..., state_count() - 1.
  Place place_count() const { return places_; }
  State state_count() const { return moves_.count(); }
  Place place(State state) const {
    return state < places_ ? state : place_of_[static_cast<std::size_t>(state - places_)];
  }

  // moves(): the states to which a move leads from `state`. moves_to(): the states from which a
  // move leads to `state`. No move connects a blocked cell with another place.
  std::span<const State> moves(State state) const { return moves_[state]; }
  std::span<const State> moves_to(State state) const {
    return is_symmetric_ ? moves_[state] : moves_back_[state];
  }
  // The other places to which a move leads from `place`, or from which a move leads to `place`.
  std::span<const Place> neighbors(Place place) const {
    return has_other_neighbors_ ? neighbors_[place] : moves_[place];
  }

  // The number of states on `place`: base states of all kinds, and states at work. It is 1 on grids
  // and roadmaps. rank_on_place() numbers these states 0, ..., states_on(place) - 1.
  int states_on(Place place) const {
    return states_are_places() ? 1
                               : bases_on_a_place_ + static_cast<int>(working_.on(place).size());
  }
  int max_states_on_a_place() const { return max_states_on_a_place_; }
  int rank_on_place(State state) const { return state < places_ ? 0 : rank_of(state); }
  // Calls visit(state) for each state on `place`, in order of rank_on_place().
  template <class Visit>
  void for_each_state(Place place, Visit visit) const {
    visit(place);
    if (states_are_places()) return;
    for (int kind = 1; kind < kind_count(); ++kind)
      for (State s = bases(place, kind).first; s < bases(place, kind).end; ++s) visit(s);
    for (const State s : working_.on(place)) visit(s);
  }

  // kind_count() includes kind 0. kind() of a state at work is the kind of its base state. bases()
  // returns the base states of one kind on a place.
  int kind_count() const { return static_cast<int>(kinds_.size()); }
  int kind(State state) const { return state < places_ ? 0 : kind_of_base(base(state)); }
  StateRange bases(Place place, int kind) const {
    const Kind& k = kinds_[kind];
    return {k.first + place * k.on_a_place, k.first + (place + 1) * k.on_a_place};
  }
  // If `state` is a state at work, the base state in which the agent works; otherwise `state`
  // itself.
  State base(State state) const { return working_.has(state) ? working_.work(state).base : state; }
  bool is_working(State state) const { return working_.has(state); }
  // Precondition: is_working(state).
  const Work& work(State state) const { return working_.work(state); }
  // The maximum time from a base state of this kind to a different one on the same place.
  Time max_turn_time(int kind) const { return kinds_[kind].max_turn_time; }

  // True if every state is equal to its place.
  bool states_are_places() const { return state_count() == places_; }
  // True if every state is equal to its place, and every move can be undone in one step.
  bool is_plain() const { return is_symmetric_ && states_are_places(); }
  // The width of the grid if the places are the cells of a grid; otherwise 0.
  Place row_width() const { return row_width_; }
  // The maximum number of moves from one state.
  int max_moves() const { return max_moves_; }

  // A name for messages, for example "[3, 4]".
  virtual std::string name(State state) const = 0;

 protected:
  // The base states of one kind: `on_a_place` states for each place, numbered place by place from
  // `first` on.
  struct Kind {
    State first = 0;
    int on_a_place = 1;
    Time max_turn_time = 0;
  };

  // Constructs a world with one state for each place. `moves` has one row for each place.
  explicit World(CsrArray moves);
  // Constructs the world of a grid with `row_width` columns. `moves` has one row for each cell, and
  // must contain the reverse of every move.
  World(CsrArray moves, Place row_width);
  // Constructs a world with the places of `ground`, more kinds of states, and states at work.
  // `kinds`: all kinds, from kind 0 on. `work`: one entry for each state at work, in order of
  // state. `moves` has one row for each state.
  World(const World& ground, std::vector<Kind> kinds, std::vector<Work> work, CsrArray moves);

 private:
  int rank_of(State state) const;
  int kind_of_base(State state) const;

  Place places_;
  Place row_width_ = 0;
  int max_moves_ = 0;
  int bases_on_a_place_ = 1;
  int max_states_on_a_place_ = 1;
  bool is_symmetric_ = true;
  bool has_other_neighbors_ = false;
  CsrArray moves_;               // by state
  CsrArray moves_back_;          // by state; empty if it would be equal to moves_
  CsrArray neighbors_;           // by place; empty if it would be equal to moves_
  std::vector<Place> place_of_;  // by state, from places_ on
  std::vector<Kind> kinds_{Kind{}};
  WorkingStates working_;
};

}  // namespace grove::detail
