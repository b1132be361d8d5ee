// SPDX-License-Identifier: MIT
#include "sequencing/cbc_solver.h"

#include <CbcEventHandler.hpp>
#include <CbcModel.hpp>
#include <ClpEventHandler.hpp>
#include <ClpSimplex.hpp>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace grove::detail::cbc {
namespace {

std::mutex& solver_mutex() {
  static std::mutex the_mutex;
  return the_mutex;
}

// Stops the tree search between nodes when a limit is reached.
class StopTree : public CbcEventHandler {
 public:
  explicit StopTree(const Limits& limits) : limits_(&limits) {}
  CbcAction event(CbcEvent) override { return limits_->stop_requested() ? stop : noAction; }
  CbcEventHandler* clone() const override { return new StopTree(*this); }

 private:
  const Limits* limits_;
};

// Stops a linear program between iterations.
class StopLinear : public ClpEventHandler {
 public:
  explicit StopLinear(const Limits& limits) : limits_(&limits) {}
  int event(Event) override { return limits_->stop_requested() ? kStoppedByEvent : kContinue; }
  ClpEventHandler* clone() const override { return new StopLinear(*this); }

 private:
  static constexpr int kContinue = -1;
  static constexpr int kStoppedByEvent = 5;
  const Limits* limits_;
};

}  // namespace

SolverLock::SolverLock(const Limits& limits) : lock_(solver_mutex(), std::defer_lock) {
  while (!limits.stop_requested() && !lock_.try_lock())
    std::this_thread::sleep_for(std::chrono::microseconds(500));
}

void fail(const char* what) {
  throw std::runtime_error(std::string("CBC returned ") + what);
}

void prepare(OsiClpSolverInterface& solver, const Limits& limits) {
  solver.messageHandler()->setLogLevel(0);
  solver.setHintParam(OsiDoReducePrint, true);
  // The presolve of CoinUtils leaks memory, and the programs are small.
  solver.setHintParam(OsiDoPresolveInInitial, false, OsiHintDo);
  solver.setHintParam(OsiDoPresolveInResolve, false, OsiHintDo);
  StopLinear handler(limits);
  solver.getModelPtr()->passInEventHandler(&handler);
}

IntegerSolution branch_and_bound(const OsiClpSolverInterface& solver, const Limits& limits) {
  IntegerSolution result;
  if (limits.stop_requested()) return result;
  CbcModel model(solver);
  model.setLogLevel(0);
  model.solver()->messageHandler()->setLogLevel(0);
  model.setAllowableGap(0);
  model.setAllowableFractionGap(0);
  model.setNumberThreads(0);  // runs in the calling thread
  StopTree handler(limits);
  model.passInEventHandler(&handler);
  if (limits.seconds_left() < 1e6) model.setMaximumSeconds(limits.seconds_left());
  model.branchAndBound();
  if (limits.stop_requested()) return result;
  result.outcome = Outcome::kInfeasible;
  if (model.isProvenInfeasible()) return result;
  if (!model.isProvenOptimal() || model.bestSolution() == nullptr) fail("no verdict");
  result.outcome = Outcome::kOptimal;
  result.values.assign(model.bestSolution(), model.bestSolution() + solver.getNumCols());
  result.objective = model.getObjValue();
  return result;
}

}  // namespace grove::detail::cbc
