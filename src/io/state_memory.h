// SPDX-License-Identifier: MIT
// Estimates the memory for the states of agents that turn or work, before these states are created.
#pragma once

#include <cstdint>
#include <set>

#include "io/input_rules.h"
#include "io/json_value.h"
#include "model/instance.h"

namespace grove::detail {

// Computes an upper bound on the number of states that InstanceBuilder::build() would create
// (model/motion_world.cpp). For each distinct turn_steps, each place has a state for each heading
// and for each step within a turn. Each task that takes time has a chain of states for each base
// state in which it can be executed: one for agents that turn freely, one for each heading and each
// distinct turn_steps, and one for an agent that starts on the task's place within a turn.
class StateMemory {
 public:
  explicit StateMemory(const InstanceBuilder& builder)
      : places_(ground(builder.map()).place_count()) {}

  void add_agent(Motion motion) {
    if (motion.turn_steps > 0) turns_.insert(motion.turn_steps);
  }
  // Call it after the last add_agent().
  void add_task(Time duration) {
    constexpr std::int64_t kHeadingCount = 4;
    if (duration == 0) return;
    work_ += (2 + kHeadingCount * std::ssize(turns_)) * (std::int64_t{duration} + 1);
  }
  // The upper bound.
  std::int64_t states() const {
    std::int64_t on_a_place = 1;
    for (const Time steps : turns_) on_a_place += 4 + 8 * (std::int64_t{steps} - 1);
    return places_ * on_a_place + work_;
  }
  // Throws InputError at `root` if the states need more memory than `rules` permits.
  void require(const JsonValue& root, const std::string& file, const InputRules& rules) const {
    if (turns_.empty() && work_ == 0) return;
    require_memory(rules, file, root.path().empty() ? "/" : root.path(), states(),
                   "states of agents that turn or work", kBytesPerState);
  }

 private:
  const std::int64_t places_;
  std::set<Time> turns_;
  std::int64_t work_ = 0;
};

}  // namespace grove::detail
