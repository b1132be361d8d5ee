// SPDX-License-Identifier: MIT
// Published methods by name, for comparison. Each is Grove's search with the parts that define the
// method.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/solve.h"

namespace grove::detail {

enum class Method : std::uint8_t {
  kAuto,  // Grove's own search, with the given options
  // Adaptations of CTS-CBS to MG-MAPF (paper, section V-B), under either policy; see
  // adaptations.cpp.
  kCtsCbsA,  // CTS-CBS-A: agents may end on any of their tasks
  kCtsCbsB,  // CTS-CBS-B: one task of each agent becomes its destination (destinations.h)
  kCtsCbsC,  // CTS-CBS-C: runs A, then B; or first B, see solve_by()
  // Plain CBS with a published low level; see baselines/low_level.h.
  kOptimalCbs,
  kHcbs,
  kMgcbs,
  kSCbs,  // CTS-CBS restricted to the tree of the best joint sequence (w = inf; paper, section IV)
  // Plain CBS with one tree per assignment, in ascending order of cost (search/route_forest.h).
  kCbsTa,  // CBS-TA (Hoenig et al. 2018): agents choose their goals
  kCbsTs,  // CBS-TS (arXiv 2510.21738): and visit tasks; assignments by integer programs
};

std::vector<Method> all_methods();
// The method's name on the command line, such as "cts-cbs-a".
std::string_view name_of(Method method);
std::optional<Method> parse_method(std::string_view name);

// True if the method requires an agent without a destination. (For kCtsCbsA, solve_by() only calls
// solve(); kCtsCbsB and kCtsCbsC run the functions of adaptations.h.)
bool is_adaptation(Method method);

// Returns `options` adapted to the searches that the method runs. Throws std::invalid_argument with
// what was expected if the options do not suit the method.
SolveOptions options_of(Method method, SolveOptions options);

// Throws std::invalid_argument with the reason if the method does not suit the instance, or if a
// start plan is given to a method that accepts none. It is an InstanceError if the reason is a
// choice in the instance.
void require_fit(Method method, const Instance& instance, const SolveOptions& options);

// Solves `instance` by the method, with the contract of solve(). `options` must be a result of
// options_of(). `anytime` (only for kCtsCbsC): run B first, then A from B's plan. Throws what
// require_fit() throws.
Solution solve_by(Method method, bool anytime, const Instance& instance,
                  const SolveOptions& options, const Limits& limits,
                  RunObserver* observer = nullptr);

}  // namespace grove::detail
