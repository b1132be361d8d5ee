// SPDX-License-Identifier: MIT
// Published methods under their names: Grove's search with what defines each, to compare with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/solve.h"

namespace grove::detail {

enum class Method : std::uint8_t {
  kAuto,  // Grove's search, as the options say
  // MG-MAPF by CTS-CBS (paper, section V-B), under either policy: adaptations.cpp.
  kCtsCbsA,  // the agents end on any of their tasks
  kCtsCbsB,  // one task of each is made its destination: destinations.h
  kCtsCbsC,  // A, then B
  // CBS, plain, with another low level: grove/baselines/low_level.h.
  kOptimalCbs,
  kHcbs,
  kMgcbs,
  kSCbs,  // CTS-CBS in the tree of the best joint sequence alone (w = inf; paper, section IV)
};

std::vector<Method> all_methods();
// As on the command line: "cts-cbs-a".
std::string_view name_of(Method method);
std::optional<Method> parse_method(std::string_view name);

// Is it for agents without a destination only, and more than solve() with other options? (A is not
// more: it is what solve() does with such agents.)
bool is_adaptation(Method method);

// Turns `options` into those of the method's searches. Throws std::invalid_argument, saying what
// was expected, where they do not go together.
SolveOptions options_of(Method method, SolveOptions options);

// Throws std::invalid_argument, saying why, if the method is not for this instance, or does not
// begin with a plan and is given one.
void require_fit(Method method, const Instance& instance, const SolveOptions& options);

// Solves `instance` by the method, which must fit, as solve() does. `options` are those of
// options_of(). `anytime`, of kCtsCbsC: first B, then A from the plan found.
Solution solve_by(Method method, bool anytime, const Instance& instance,
                  const SolveOptions& options, const Limits& limits,
                  RunObserver* observer = nullptr);

}  // namespace grove::detail
