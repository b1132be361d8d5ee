// SPDX-License-Identifier: MIT
// Instances in which agents pay for their choices.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assignment/route_bound.h"
#include "model/choices.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"
#include "model/plan.h"
#include "planning/agent_prices.h"

namespace grove::detail {

// An exact reformulation of an instance with choices, for plans that cost less than a cutoff.
// Reduced cost fixing removes choices that no such plan contains. In `instance` an agent must visit
// the remaining optional tasks; `prices` states which of them it may leave out, and at which price.
// plan_of() converts paths of the agents to a plan of the original instance. The proof is at the
// head of priced_instance.cpp.
struct PricedInstance {
  Instance instance;  // with the agents and tasks of the original instance, at the same indices
  Prices prices;
};

// Returns a choice that certificates do not cover (docs/proof.md, "choices"); nullopt: they cover
// all. Such a choice is that of an agent that needs time to turn, that starts while it executes an
// optional task, that has more than kMaxCertifiedTasks tasks or an optional task on the place of
// another one, or that has no destination and must visit a task.
inline constexpr int kMaxCertifiedTasks = 63;
std::optional<Choice> find_uncertified_choice(const Instance& instance);

// The result of price_choices().
enum class Pricing : std::uint8_t {
  kDone,
  kNoPlan,       // proven: no plan costs less than the cutoff
  kNotPossible,  // see price_choices()
};

// kNone: all choices are left, as in a certificate.
enum class Fixing : std::uint8_t { kByReducedCosts, kNone };

// Makes the reformulation for plans that cost less than `cutoff`. The lower the cutoff, the fewer
// choices are left, unless `fixing` is kNone. kNotPossible: an agent with a choice would have more
// than kMaxTasksPerAgent tasks; or it starts at work and has a task without a duration on its
// start; or `bound` has no result; or a limit is reached.
Pricing price_choices(const Instance& instance, RouteBound& bound, Cost cutoff, Fixing fixing,
                      const Limits& limits, std::optional<PricedInstance>& priced);

// Makes a plan of `instance` of paths in `priced.instance`. Precondition: the paths have no
// conflicts, count the tasks as often as needed, and end where they may.
Plan plan_of(const Instance& instance, const PricedInstance& priced,
             const std::vector<CountedPath>& paths);

}  // namespace grove::detail
