// SPDX-License-Identifier: MIT
// Assignment of shared stops to agents and sequencing in one problem: one interface, three exact
// back ends.
#pragma once

#include <cstdint>
#include <memory>

#include "model/limits.h"
#include "sequencing/joint_routes.h"
#include "sequencing/rtsp.h"

namespace grove::detail {

// Result of JointRouteSolver::best().
struct JointRouteAnswer {
  enum class Kind : std::uint8_t {
    kExact,       // `route` is a cheapest member of the class
    kInfeasible,  // proven: the class has no member of finite cost
    kStopped,     // a limit was reached, or the back end needs too much memory
  };
  Kind kind = Kind::kStopped;
  JointRoute route = {};
};

// Finds cheapest members of classes of joint routes. One thread at a time; different threads may
// use different solvers (a mutex serializes the CBC back end).
class JointRouteSolver {
 public:
  virtual ~JointRouteSolver() = default;
  // The CBC back end throws std::runtime_error if CBC returns a wrong result.
  virtual JointRouteAnswer best(const JointRouteClass& joint_class) = 0;
};

// Makes a solver. kAuto: tables if they are small; otherwise a matching if no task is shared;
// otherwise the integer program. kHeldKarp and kBoundedDp: tables or, if no task is shared, a
// matching. kCbc: the integer program. `problem` and `limits` must outlive the solver. Throws
// std::invalid_argument if the back end is not built. Problems that are too large for the back end
// stop the run (Limits::memory_exhausted).
std::unique_ptr<JointRouteSolver> make_joint_route_solver(RtspBackend backend,
                                                          const JointRouteProblem& problem,
                                                          const Limits& limits);

// The back ends. The file with the name of the back end defines it.
//
// Tables; returns nullptr if they would be too large.
std::unique_ptr<JointRouteSolver> make_joint_route_tables(const JointRouteProblem& problem,
                                                          const Limits& limits);
// Assignment problem; returns nullptr if a task is shared, or an agent has too many stops.
std::unique_ptr<JointRouteSolver> make_joint_route_matching(const JointRouteProblem& problem,
                                                            const Limits& limits);
// Integer program.
std::unique_ptr<JointRouteSolver> make_joint_route_program(const JointRouteProblem& problem,
                                                           const Limits& limits);

}  // namespace grove::detail
