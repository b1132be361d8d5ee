// SPDX-License-Identifier: MIT
#include "sequencing/joint_route_solver.h"

#include <stdexcept>

namespace grove::detail {
namespace {

// Stands in for a back end that would need too much memory.
class TooLarge : public JointRouteSolver {
 public:
  explicit TooLarge(const Limits& limits) : limits_(limits) {}
  JointRouteAnswer best(const JointRouteClass&) override {
    limits_.memory_exhausted();
    return {};
  }

 private:
  const Limits& limits_;
};

std::unique_ptr<JointRouteSolver> make_program(const JointRouteProblem& problem,
                                               const Limits& limits) {
#ifdef GROVE_WITH_CBC
  return make_joint_route_program(problem, limits);
#else
  static_cast<void>(problem);
  static_cast<void>(limits);
  throw std::invalid_argument("Grove was built without CBC (GROVE_WITH_CBC)");
#endif
}

}  // namespace

std::unique_ptr<JointRouteSolver> make_joint_route_solver(RtspBackend backend,
                                                          const JointRouteProblem& problem,
                                                          const Limits& limits) {
  if (backend == RtspBackend::kCbc) return make_program(problem, limits);
  if (auto tables = make_joint_route_tables(problem, limits)) return tables;
  if (auto matching = make_joint_route_matching(problem, limits)) return matching;
  if (backend == RtspBackend::kAuto && is_built(RtspBackend::kCbc))
    return make_program(problem, limits);
  return std::make_unique<TooLarge>(limits);
}

}  // namespace grove::detail
