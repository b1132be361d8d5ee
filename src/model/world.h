// SPDX-License-Identifier: MIT
// Where agents can be, and what they block there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grove::detail {

// What one agent blocks: a cell of a grid, say. Meaningful only together with its world.
using Place = std::int32_t;
inline constexpr Place kNoPlace = -1;

// Where an agent can be in its own motion: it stands on a place, perhaps with a heading or at work.
// Meaningful only together with its world.
using State = std::int32_t;
inline constexpr State kNoState = -1;

// A discrete time or a duration, in steps.
using Time = std::int32_t;
// No time at all: later than every time a plan can mention. Safe to add small durations to.
inline constexpr Time kNever = 1 << 30;

using TaskIndex = std::int32_t;  // position in Instance::tasks()

// Lists of numbers, one after the other in one array.
class CsrArray {
 public:
  // Appends to the row under way, and ends it.
  void add(std::int32_t item) { items_.push_back(item); }
  void end_row() { first_.push_back(static_cast<std::int32_t>(items_.size())); }

  std::int32_t count() const { return static_cast<std::int32_t>(first_.size()) - 1; }
  std::span<const std::int32_t> operator[](std::int32_t row) const {
    return {items_.data() + first_[row], items_.data() + first_[row + 1]};
  }
  std::span<const std::int32_t> items() const { return items_; }

 private:
  std::vector<std::int32_t> first_{0};  // by row; one more at the end
  std::vector<std::int32_t> items_;
};

// States first .. end - 1.
struct StateRange {
  State first = 0;
  State end = 0;
};

// An agent at work on a task: its work has taken `done` steps of as many as the task takes; then it
// is completed.
struct Work {
  TaskIndex task = -1;
  Time done = 0;
  bool completed = false;
  State base = kNoState;  // in which it works
};

// Places, the states that stand on them, and the moves of one step between states; waiting is
// possible in every state and no move (docs/design.md, section 1). States come in *kinds*, one for
// each way to move, between which no move leads. States 0 .. place_count() - 1 are kind 0, that of
// agents that turn freely: each is its place, and grids and roadmaps have no others. Beyond these
// *base* states there are those of agents at work (motion_world.h). Immutable after construction,
// so any number of threads may read one.
class World {
 public:
  World(const World&) = default;
  World(World&&) = default;
  World& operator=(const World&) = default;
  World& operator=(World&&) = default;
  virtual ~World() = default;

  // Places and states are numbered 0 .. count - 1.
  Place place_count() const { return places_; }
  State state_count() const { return moves_.count(); }
  Place place(State state) const {
    return state < places_ ? state : place_of_[static_cast<std::size_t>(state - places_)];
  }

  // The states that one step leads to from `state`, and those from which one leads to it. None for
  // a blocked cell.
  std::span<const State> moves(State state) const { return moves_[state]; }
  std::span<const State> moves_to(State state) const {
    return is_symmetric_ ? moves_[state] : moves_back_[state];
  }
  // The places that a step leads to from this one or leads from to it.
  std::span<const Place> neighbors(Place place) const {
    return has_other_neighbors_ ? neighbors_[place] : moves_[place];
  }

  // States on one place, of all kinds and at work, which are numbered from 0 there: one, on grids
  // and roadmaps.
  int states_on(Place place) const {
    return states_are_places() ? 1 : bases_on_a_place_ + static_cast<int>(working_[place].size());
  }
  int most_states_on_a_place() const { return most_states_on_a_place_; }
  int rank_on_place(State state) const { return state < places_ ? 0 : rank_of(state); }
  // Calls visit(state) for each of them, in the order of their ranks.
  template <class Visit>
  void for_each_state(Place place, Visit visit) const {
    visit(place);
    if (states_are_places()) return;
    for (int kind = 1; kind < kind_count(); ++kind)
      for (State s = bases(place, kind).first; s < bases(place, kind).end; ++s) visit(s);
    for (const State s : working_[place]) visit(s);
  }

  // The base states of a kind on a place.
  int kind_count() const { return static_cast<int>(kinds_.size()); }
  int kind(State state) const { return state < places_ ? 0 : kind_of_base(base(state)); }
  StateRange bases(Place place, int kind) const {
    const Kind& k = kinds_[kind];
    return {k.first + place * k.on_a_place, k.first + (place + 1) * k.on_a_place};
  }
  // The state itself, or that in which an agent at work works: the moves of the last state of work
  // are those of its base state.
  State base(State state) const {
    return state < first_working_ ? state : work_[state - first_working_].base;
  }
  bool is_working(State state) const { return state >= first_working_; }
  // Only of those that are.
  const Work& work(State state) const { return work_[state - first_working_]; }
  // How many steps it takes at most to come from any base state of an agent's kind to any other on
  // the same place.
  Time max_turn_time(int kind) const { return kinds_[kind].max_turn_time; }

  // Every state is its place.
  bool states_are_places() const { return state_count() == places_; }
  // And every step can be undone.
  bool is_plain() const { return is_symmetric_ && states_are_places(); }
  // If the places are the cells of a grid, how many there are in a row of it; else 0.
  Place row_width() const { return row_width_; }
  // How many moves there are from a state at most.
  int most_moves() const { return most_moves_; }

  // For people: "[3, 4]".
  virtual std::string name(State state) const = 0;

 protected:
  // States of one kind: so many on each place, place by place from `first` on.
  struct Kind {
    State first = 0;
    int on_a_place = 1;
    Time max_turn_time = 0;
  };

  // One state for each place; moves by place.
  explicit World(CsrArray moves);
  // The same for the cells of a grid, so many in a row, with moves that can all be undone.
  World(CsrArray moves, Place row_width);
  // The places of another world, with further kinds of states, and states at work. Moves by state;
  // `work` is of the states behind those of all kinds.
  World(const World& ground, std::vector<Kind> kinds, std::vector<Work> work, CsrArray moves);

 private:
  int rank_of(State state) const;
  int kind_of_base(State state) const;

  Place places_;
  Place row_width_ = 0;
  int most_moves_ = 0;
  int bases_on_a_place_ = 1;
  int most_states_on_a_place_ = 1;
  bool is_symmetric_ = true;
  bool has_other_neighbors_ = false;
  State first_working_;
  CsrArray moves_;       // by state
  CsrArray moves_back_;  // by state, unless they are the same
  CsrArray neighbors_;   // by place, unless they are the moves of the states
  CsrArray working_;     // by place: the states at work there, if any state is not its place
  std::vector<Place> place_of_;  // of the states that are not their place
  std::vector<Kind> kinds_{Kind{}};
  std::vector<Work> work_;               // of the states from first_working_ on
  std::vector<std::int32_t> work_rank_;  // of the same: in working_ of the place
};

}  // namespace grove::detail
