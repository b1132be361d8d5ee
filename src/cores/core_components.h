// SPDX-License-Identifier: MIT
// Groups of agents that are connected by unsatisfiable cores.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"
#include "search/covering.h"

namespace grove::detail {

// Groups of agents that share cores: a core whose agents are in several components joins them. The
// agents of a component together cost at least the sum of their least costs plus the amount by
// which the cores of the component have raised the bound (proof: core_search.cpp). One thread at a
// time.
class CoreComponents {
 public:
  // Maximum number of agents in a statement of take_excesses().
  static constexpr std::size_t kMaxGroup = 10;

  // A core of these agents, in ascending order, has raised the bound by `raised`.
  // `is_unconditional`: it holds for all plans, whatever they cost.
  void add(std::span<const AgentIndex> agents, Cost raised, bool is_unconditional);
  // Whether a core depends on the agent.
  bool contains(AgentIndex agent) const {
    return agent < std::ssize(component_of_) && component_of_[agent] >= 0;
  }
  // Returns the statements about groups of two agents or more since the last call. They hold for
  // all plans.
  std::vector<GroupExcess> take_excesses() { return std::exchange(excesses_, {}); }

 private:
  std::vector<std::int32_t> component_of_;  // by AgentIndex; -1: in no core yet
  std::vector<GroupExcess> components_;     // those that were joined to others have no agents
  std::vector<GroupExcess> excesses_;
};

}  // namespace grove::detail
