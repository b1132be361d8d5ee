// SPDX-License-Identifier: MIT
// State machine whose states own data.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "model/assert.h"

namespace grove::detail {

template <class Name>
struct Transition {
  Name from;
  Name to;
  friend bool operator==(const Transition&, const Transition&) = default;
};

// The current state is an object of one of the types `States`. It owns the data that exist only in
// this state. `Name`: an enum that numbers `States` from 0, in the same order. One thread at a
// time.
template <class Name, class... States>
class StateMachine {
 public:
  // `permitted`: all permitted transitions; must outlive this object.
  template <class State>
  StateMachine(State first, std::span<const Transition<Name>> permitted)
      : state_(std::move(first)), permitted_(permitted) {}

  Name name() const { return static_cast<Name>(state_.index()); }
  // The data of the current state, which must be of type `State`.
  template <class State>
  State& as() {
    return state_of<State>(*this);
  }
  template <class State>
  const State& as() const {
    return state_of<State>(*this);
  }

  // Replaces the current state. The transition must be permitted.
  template <class State>
  void enter(State next) {
    const Transition<Name> transition{name(), name_of<State>()};
    GROVE_CHECK(std::ranges::find(permitted_, transition) != permitted_.end(),
                "a transition is in the table of transitions");
    state_ = std::move(next);
  }

 private:
  template <class State, class Machine>
  static auto& state_of(Machine& machine) {
    auto* const state = std::get_if<State>(&machine.state_);
    GROVE_CHECK(state != nullptr, "the data of a state are used only in this state");
    return *state;
  }
  template <class State>
  static constexpr Name name_of() {
    constexpr std::array<bool, sizeof...(States)> kIsState{std::is_same_v<State, States>...};
    return static_cast<Name>(std::ranges::find(kIsState, true) - kIsState.begin());
  }

  std::variant<States...> state_;
  std::span<const Transition<Name>> permitted_;
};

}  // namespace grove::detail
