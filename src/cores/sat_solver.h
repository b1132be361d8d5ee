// SPDX-License-Identifier: MIT
// Incremental SAT solver: a wrapper of CaDiCaL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>

#include "model/limits.h"
#include "search/proof_log.h"

namespace grove::detail {

// A Boolean variable v > 0, or its negation -v.
using Literal = std::int32_t;

// One thread at a time. Without a time limit, all results depend only on the sequence of calls.
class SatSolver {
 public:
  enum class Result : std::uint8_t { kSatisfiable, kUnsatisfiable, kUnknown };

  // `limits` and `proof` must outlive this object. When the limits are reached, solve() returns
  // kUnknown. If `proof` is not nullptr, logs the variables, the clauses that the solver derives,
  // and those that it deletes.
  explicit SatSolver(const Limits& limits, ProofLog* proof = nullptr);
  ~SatSolver();

  // `kind` and `meaning` define the variable in a proof (FormulaKind).
  Literal new_variable(FormulaKind kind, std::initializer_list<std::int64_t> meaning);
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
  void end_preference(Literal literal);

  // Logs a line of the proof after all clauses derived so far. Does nothing without a proof.
  void log(FormulaKind kind, std::span<const std::int64_t> numbers);
  void log(FormulaKind kind, std::initializer_list<std::int64_t> numbers) {
    log(kind, {numbers.begin(), numbers.size()});
  }
  // Logs the sum of `inputs` and returns its number.
  std::int64_t log_sum(std::span<const Literal> inputs);
  bool has_proof() const { return proof_ != nullptr; }

  std::int64_t variables() const { return variables_; }
  std::int64_t conflicts() const;
  // Effort so far in the unit of model/effort.h.
  std::int64_t work() const;
  // Estimated memory in bytes.
  std::size_t bytes() const;

 private:
  class Solver;
  ProofLog* const proof_;
  std::unique_ptr<Solver> solver_;
  std::int64_t sums_ = 0;
  std::int64_t variables_ = 0;
};

}  // namespace grove::detail
