// SPDX-License-Identifier: MIT
#include "cores/sat_solver.h"

#include <cadical.hpp>
#include <cstdlib>

#include "model/assert.h"
#include "model/effort.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kRoundsPerPoll = 256;

// Counts the conflicts and the rounds of the solver's main loop, and stops it at the limits.
class Watcher : public CaDiCaL::Terminator, public CaDiCaL::Learner {
 public:
  explicit Watcher(const Limits& limits) : limits_(limits) {}

  bool terminate() override { return ++rounds % kRoundsPerPoll == 0 && limits_.stop_requested(); }
  bool learning(int) override {
    ++conflicts;
    return false;
  }
  void learn(int) override {}

  std::int64_t rounds = 0;
  std::int64_t conflicts = 0;

 private:
  const Limits& limits_;
};

}  // namespace

class SatSolver::Solver {
 public:
  explicit Solver(const Limits& limits) : watcher(limits) {
    solver.set("quiet", 1);
    // Inprocessing takes more time than it saves, because clauses are added all the time. Models
    // need few nodes, so variables are false by default. (Fourteen instances: 0.84 of the time.)
    solver.set("inprocessing", 0);
    solver.set("phase", 0);
    solver.connect_terminator(&watcher);
    solver.connect_learner(&watcher);
  }
  ~Solver() {
    solver.disconnect_terminator();
    solver.disconnect_learner();
  }

  Watcher watcher;
  CaDiCaL::Solver solver;
};

SatSolver::SatSolver(const Limits& limits) : solver_(std::make_unique<Solver>(limits)) {}

SatSolver::~SatSolver() = default;

Literal SatSolver::new_variable() {
  return static_cast<Literal>(++variables_);
}

void SatSolver::add(std::span<const Literal> clause) {
  for (const Literal literal : clause) {
    GROVE_ASSERT(literal != 0 && std::abs(literal) <= variables_, "a clause has known variables");
    solver_->solver.add(literal);
  }
  solver_->solver.add(0);
  literals_ += std::ssize(clause);
}

SatSolver::Result SatSolver::solve(std::span<const Literal> assumptions, int max_conflicts) {
  CaDiCaL::Solver& solver = solver_->solver;
  for (const Literal literal : assumptions) solver.assume(literal);
  solves_work_ += variables_ / effort::kSolverVariables;
  solver.limit("conflicts", max_conflicts);
  switch (solver.solve()) {
    case 10:
      return Result::kSatisfiable;
    case 20:
      return Result::kUnsatisfiable;
    default:
      return Result::kUnknown;
  }
}

bool SatSolver::is_true(Literal literal) const {
  return solver_->solver.val(literal) > 0;
}

bool SatSolver::failed(Literal literal) const {
  return solver_->solver.failed(literal);
}

void SatSolver::prefer(Literal literal) {
  solver_->solver.phase(literal);
}

std::int64_t SatSolver::conflicts() const {
  return solver_->watcher.conflicts;
}

std::int64_t SatSolver::work() const {
  return solves_work_ + solver_->watcher.rounds * effort::kPerSolverRound +
         solver_->watcher.conflicts * effort::kPerSolverConflict + literals_;
}

std::size_t SatSolver::bytes() const {
  constexpr std::size_t kPerVariable = 200;
  constexpr std::size_t kPerLiteral = 12;
  return static_cast<std::size_t>(variables_) * kPerVariable +
         static_cast<std::size_t>(literals_ + 40 * conflicts()) * kPerLiteral;
}

}  // namespace grove::detail
