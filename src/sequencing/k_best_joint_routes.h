// SPDX-License-Identifier: MIT
// K best joint routes, that is, joint assignments of shared tasks with sequences, computed lazily.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "model/limits.h"
#include "sequencing/joint_route_solver.h"

namespace grove::detail {

// Enumerates all joint routes of finite cost exactly once, in ascending order of cost. One thread
// at a time. Discard the object if a method throws.
class KBestJointRoutes {
 public:
  // `solver` must have been made for `problem`. `problem` and `limits` must outlive this object.
  KBestJointRoutes(const JointRouteProblem& problem, std::unique_ptr<JointRouteSolver> solver,
                   const Limits& limits);
  ~KBestJointRoutes();
  KBestJointRoutes(KBestJointRoutes&&) noexcept;

  // Returns a proven lower bound on the cost of the next joint route, without further search.
  // kInfiniteCost: proven that none is left. Never decreases.
  Cost lower_bound() const;
  // Returns the next joint route in order of cost. Returns nullopt if all were returned
  // (lower_bound() is then kInfiniteCost), or if a limit was reached or the solver stopped.
  std::optional<JointRoute> next();

  // Number of calls of the solver so far.
  std::int64_t solver_calls() const;

 private:
  class Partition;
  std::unique_ptr<Partition> partition_;
};

}  // namespace grove::detail
