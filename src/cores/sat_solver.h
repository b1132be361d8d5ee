// SPDX-License-Identifier: MIT
// Incremental SAT solver: a wrapper of CaDiCaL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>

#include "model/limits.h"

namespace grove::detail {

// A Boolean variable v > 0, or its negation -v.
using Literal = std::int32_t;

// One thread at a time. Without a time limit, all results depend only on the sequence of calls.
class SatSolver {
 public:
  enum class Result : std::uint8_t { kSatisfiable, kUnsatisfiable, kUnknown };

  // `limits` must outlive this object; when they are reached, solve() returns kUnknown.
  explicit SatSolver(const Limits& limits);
  ~SatSolver();

  Literal new_variable();
  void add(std::span<const Literal> clause);
  void add(std::initializer_list<Literal> clause) { add({clause.begin(), clause.size()}); }

  // Is there an assignment that satisfies all clauses and assumptions? kUnknown after
  // `max_conflicts` conflicts.
  Result solve(std::span<const Literal> assumptions, int max_conflicts);
  // After kSatisfiable: the value of a literal.
  bool is_true(Literal literal) const;
  // After kUnsatisfiable: whether the assumption `literal` was needed for the refutation.
  bool failed(Literal literal) const;
  // Decisions on the variable of `literal` try this value first.
  void prefer(Literal literal);

  std::int64_t variables() const { return variables_; }
  std::int64_t conflicts() const;
  // Effort so far in the unit of model/effort.h.
  std::int64_t work() const;
  // Estimated memory in bytes.
  std::size_t bytes() const;

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
  std::int64_t variables_ = 0;
  std::int64_t literals_ = 0;  // in added clauses
  std::int64_t solves_work_ = 0;
};

}  // namespace grove::detail
