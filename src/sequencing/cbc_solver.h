// SPDX-License-Identifier: MIT
// Calls of CBC within the limits of a run. Only for files that are compiled with CBC.
//
// *Exactness.* The absolute and the relative gap are 0. A solve that stops early has no result.
// *Threads.* CBC is not thread-safe, so the whole process solves one program at a time. The code
// uses only the classes of CBC, because its driver (CbcMain) would install signal handlers and
// print.
#pragma once

#include <OsiClpSolverInterface.hpp>
#include <cstdint>
#include <mutex>
#include <vector>

#include "model/limits.h"

namespace grove::detail::cbc {

inline constexpr double kIntegral = 1e-5;  // tolerance; a value further from an integer is an error

// Process-wide lock that a thread holds while it solves a program. The constructor waits for the
// lock and polls the limits; is_locked() is false if a limit was reached first.
class SolverLock {
 public:
  explicit SolverLock(const Limits& limits);
  bool is_locked() const { return lock_.owns_lock(); }

 private:
  std::unique_lock<std::mutex> lock_;
};

// Throws std::runtime_error: CBC returned `what`.
[[noreturn]] void fail(const char* what);

// Makes the solver of linear programs silent, and stops it between iterations when a limit is
// reached. The result after such a stop must not be used. `limits` must outlive the solver.
void prepare(OsiClpSolverInterface& solver, const Limits& limits);

enum class Outcome : std::uint8_t { kOptimal, kInfeasible, kStopped };

struct IntegerSolution {
  Outcome outcome = Outcome::kStopped;
  std::vector<double> values;  // by column
  double objective = 0;
};

// Solves the integer program in the calling thread. Precondition: it holds a SolverLock.
IntegerSolution branch_and_bound(const OsiClpSolverInterface& solver, const Limits& limits);

}  // namespace grove::detail::cbc
