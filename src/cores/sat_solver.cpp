// SPDX-License-Identifier: MIT
#include "cores/sat_solver.h"

#include <algorithm>
#include <cadical.hpp>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <unordered_map>
#include <vector>

#include "model/assert.h"
#include "model/effort.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kRoundsPerPoll = 256;

// Counts the work of the solver, and stops it at the limits.
class Watcher : public CaDiCaL::Terminator, public CaDiCaL::Learner {
 public:
  explicit Watcher(const Limits& limits) : limits_(limits) {}

  bool terminate() override {
    work += effort::kPerSolverRound;
    if (++rounds_ < next_poll_) return false;
    next_poll_ = rounds_ + kRoundsPerPoll;
    return limits_.stop_requested();
  }
  bool learning(int size) override {
    ++conflicts;
    next_poll_ = 0;  // in a large formula, a conflict can take long
    work += effort::kPerLearnedLiteral * size + literals / effort::kSolverLiterals;
    return false;
  }
  void learn(int) override {}

  std::int64_t literals = 0;  // in added clauses
  std::int64_t conflicts = 0;
  std::int64_t work = 0;  // of all calls (model/effort.h)

 private:
  const Limits& limits_;
  std::int64_t rounds_ = 0;     // of the solver's main loop
  std::int64_t next_poll_ = 0;  // the number of rounds at which the limits are polled
};

// Reads a trace in the binary DRAT format, which arrives in pieces, and logs it. A step is 'a' or
// 'd', the literals of a clause that was added or deleted, and 0. Only clauses that the solver has
// derived are logged as deleted.
class TraceReader {
 public:
  explicit TraceReader(ProofLog& proof) : proof_(proof) {}

  void read(const char* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) take(static_cast<unsigned char>(bytes[i]));
  }

  // Takes a number for a clause that is logged without a step.
  void count_clause() { ++clauses_; }

 private:
  void take(unsigned char byte) {
    if (step_ == 0) {
      step_ = byte;
      GROVE_CHECK(step_ == 'a' || step_ == 'd', "a step adds or deletes a clause");
      return;
    }
    number_ |= static_cast<std::uint64_t>(byte & 0x7f) << shift_;
    shift_ += 7;
    if ((byte & 0x80) != 0) return;
    const auto variable = static_cast<std::int64_t>(number_ >> 1);
    const bool is_negated = (number_ & 1) != 0;
    const bool ends = number_ == 0;
    number_ = 0;
    shift_ = 0;
    if (!ends) return clause_.push_back(is_negated ? -variable : variable);
    end_step();
    step_ = 0;
    clause_.clear();
  }

  // The hash tells derived clauses apart. If two have the same hash, the wrong one may be dropped;
  // the worst effect is that the certificate is refused.
  void end_step() {
    std::ranges::sort(clause_);
    std::uint64_t hash = 0;
    for (const std::int64_t literal : clause_) {
      hash = (hash ^ static_cast<std::uint64_t>(literal)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29;
    }
    std::vector<std::int64_t>& same = known_[hash];
    if (step_ == 'a') {
      same.push_back(clauses_++);
      proof_.formula(FormulaKind::kClause, clause_);
    } else if (!same.empty()) {
      proof_.formula(FormulaKind::kDrop, {&same.back(), 1});
      same.pop_back();
    }
    if (same.empty()) known_.erase(hash);
  }

  ProofLog& proof_;
  unsigned char step_ = 0;
  std::uint64_t number_ = 0;
  int shift_ = 0;
  std::vector<std::int64_t> clause_;
  std::int64_t clauses_ = 0;
  std::unordered_map<std::uint64_t, std::vector<std::int64_t>> known_;  // numbers by hash
};

// A stdio stream that passes all bytes to a TraceReader.
std::FILE* open_trace(TraceReader& reader) {
  const cookie_io_functions_t functions{
      .read = nullptr,
      .write = [](void* cookie, const char* bytes, std::size_t size) -> ssize_t {
        static_cast<TraceReader*>(cookie)->read(bytes, size);
        return static_cast<ssize_t>(size);
      },
      .seek = nullptr,
      .close = nullptr};
  return ::fopencookie(&reader, "w", functions);
}

}  // namespace

class SatSolver::Solver {
 public:
  Solver(const Limits& limits, ProofLog* proof) : watcher(limits) {
    solver.set("quiet", 1);
    // Inprocessing takes more time than it saves, because clauses are added all the time, and
    // without it each derived clause follows by unit propagation. Models need few nodes, so
    // variables are false by default. (Fourteen instances: 0.84 of the time.)
    solver.set("inprocessing", 0);
    solver.set("phase", 0);
    // A restart, and a jump over many levels, repeats most of the propagation: formulas have
    // hundreds of thousands of variables, and most conflicts are local. (Two instances with 100
    // agents and 300 tasks: fewer restarts 0.69, fewer jumps 0.87 of the time.)
    solver.set("restartint", 50);
    solver.set("chronolevelim", 20'000);
    if (proof != nullptr) {
      reader.emplace(*proof);
      trace = open_trace(*reader);
      GROVE_CHECK(trace != nullptr, "there is memory for a stream");
      solver.trace_proof(trace, "proof");
    }
    solver.connect_terminator(&watcher);
    solver.connect_learner(&watcher);
  }
  ~Solver() {
    solver.disconnect_terminator();
    solver.disconnect_learner();
    if (trace == nullptr) return;
    solver.close_proof_trace();
    std::fclose(trace);
  }

  Watcher watcher;
  std::optional<TraceReader> reader;
  std::FILE* trace = nullptr;
  CaDiCaL::Solver solver;
};

SatSolver::SatSolver(const Limits& limits, ProofLog* proof)
    : proof_(proof), solver_(std::make_unique<Solver>(limits, proof)) {
  log(FormulaKind::kBegin, {});
}

SatSolver::~SatSolver() = default;

Literal SatSolver::new_variable(FormulaKind kind, std::initializer_list<std::int64_t> meaning) {
  if (proof_ != nullptr) proof_->formula(kind, {meaning.begin(), meaning.size()});
  return static_cast<Literal>(++variables_);
}

void SatSolver::log(FormulaKind kind, std::span<const std::int64_t> numbers) {
  if (proof_ == nullptr) return;
  solver_->solver.flush_proof_trace();
  std::fflush(solver_->trace);
  if (kind == FormulaKind::kClause) solver_->reader->count_clause();
  proof_->formula(kind, numbers);
}

std::int64_t SatSolver::log_sum(std::span<const Literal> inputs) {
  if (proof_ != nullptr)
    proof_->formula(FormulaKind::kSum, std::vector<std::int64_t>(inputs.begin(), inputs.end()));
  return sums_++;
}

void SatSolver::add(std::span<const Literal> clause) {
  for (const Literal literal : clause) {
    GROVE_ASSERT(literal != 0 && std::abs(literal) <= variables_, "a clause has known variables");
    solver_->solver.add(literal);
  }
  solver_->solver.add(0);
  solver_->watcher.literals += std::ssize(clause);
}

SatSolver::Result SatSolver::solve(std::span<const Literal> assumptions, int max_conflicts) {
  CaDiCaL::Solver& solver = solver_->solver;
  for (const Literal literal : assumptions) solver.assume(literal);
  solver_->watcher.work += variables_ / effort::kSolverVariables;
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

void SatSolver::end_preference(Literal literal) {
  solver_->solver.unphase(literal);
}

std::int64_t SatSolver::conflicts() const {
  return solver_->watcher.conflicts;
}

std::int64_t SatSolver::work() const {
  return solver_->watcher.work + solver_->watcher.literals;
}

std::size_t SatSolver::bytes() const {
  constexpr std::size_t kPerVariable = 200;
  constexpr std::size_t kPerLiteral = 12;
  return static_cast<std::size_t>(variables_) * kPerVariable +
         static_cast<std::size_t>(solver_->watcher.literals + 40 * conflicts()) * kPerLiteral;
}

}  // namespace grove::detail
