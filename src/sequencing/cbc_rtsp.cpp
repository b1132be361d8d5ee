// SPDX-License-Identifier: MIT
// Solves rTSPs as integer programs with CBC, as in the paper. This back end serves as an
// independent check of the dynamic programs.
//
// *Formulation.* First the class is contracted: its prefix becomes the start, and the legs from the
// start to forbidden next stops are removed. The remaining problem is a shortest Hamiltonian path
// from the start through all stops to the end or, with start and end merged into one place
// "outside", a shortest cycle through all places:
//
//   minimize  sum of cost(i, j) * x(i, j)      over 0-1 variables for legs that exist,
//   every place is left once and entered once,
//   sum of x within C <= |C| - 1               for sets C of stops.
//
// *Subtour elimination.* Of the exponentially many rows for sets C, the program contains only those
// for pairs at first (Dantzig, Fulkerson and Johnson 1954). The others are added *between* solves,
// for the subtours in the solution that do not contain the outside: first for the linear
// relaxation, until its solution is connected, then for the integer program. A solution without
// such a subtour is optimal for the full program, because it is optimal for a program with fewer
// rows. Cuts that callbacks add inside CBC would be lost in its presolve and its restarts.
//
// *Exactness.* The code checks that the solution is an integral path, and recomputes its cost in
// integers. If a solve stops early, the answer is kStopped. See also cbc_solver.h.
#include <CoinPackedMatrix.hpp>
#include <CoinPackedVector.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "sequencing/cbc_solver.h"
#include "sequencing/rtsp.h"
#include "sequencing/sequence_class.h"

namespace grove::detail {
namespace {

// A class without its prefix: the remaining stops, renumbered, and their cost matrix.
struct Contracted {
  std::vector<Stop> stops;
  CostMatrix matrix;
};

Contracted contract(const CostMatrix& matrix, const ClassRoot& root) {
  Contracted result;
  for_each_stop(root.left, [&](int stop) { result.stops.push_back(static_cast<Stop>(stop)); });
  const int m = static_cast<int>(result.stops.size());
  result.matrix.cost = CostMatrix::Matrix(m + 1);
  for (int i = 0; i < m; ++i) {
    const int stop = result.stops[i];
    for (int j = 0; j < m; ++j) result.matrix.cost(i, j) = matrix.between(stop, result.stops[j]);
    result.matrix.cost(i, m) = matrix.to_end(stop);
    result.matrix.cost(m, i) =
        (root.next & bit(stop)) != 0 ? matrix.between(root.last, stop) : kNever;
  }
  return result;
}

// The integer program of one contracted class. Its places are the stops and, as the last one, the
// outside.
class PathProgram {
 public:
  using Outcome = cbc::Outcome;

  PathProgram(const CostMatrix& matrix, const Limits& limits)
      : matrix_(matrix), limits_(limits), places_(matrix.stops() + 1) {
    cbc::prepare(solver_, limits_);
    load();
  }

  Outcome solve() {
    solver_.initialSolve();
    while (!stopped() && solver_.isProvenOptimal() && cut_off_cycles(solver_.getColSolution()))
      solver_.resolve();
    if (!stopped() && solver_.isProvenPrimalInfeasible()) return Outcome::kInfeasible;
    for (int leg = 0; leg < std::ssize(legs_); ++leg) solver_.setInteger(leg);
    Outcome outcome = Outcome::kOptimal;
    do {
      outcome = branch_and_bound();
    } while (outcome == Outcome::kOptimal && cut_off_cycles(solution_.data()));
    return outcome;
  }

  // Returns the path that the solution describes. Throws std::runtime_error if it describes none.
  Sequence path() const {
    std::vector<int> next(places_, -1);
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      if (std::abs(solution_[i] - std::round(solution_[i])) > cbc::kIntegral)
        cbc::fail("a fraction");
      if (solution_[i] < 0.5) continue;
      if (next[legs_[i].first] != -1) cbc::fail("two legs from one place");
      next[legs_[i].first] = legs_[i].second;
    }
    Sequence path;
    for (int at = next[outside()]; at != outside() && std::ssize(path) < outside(); at = next[at]) {
      if (at < 0) cbc::fail("an open end");
      path.push_back(static_cast<Stop>(at));
    }
    if (std::ssize(path) != outside()) cbc::fail("a path that misses a stop");
    return path;
  }

  double objective() const { return objective_; }

 private:
  using Leg = std::pair<int, int>;

  int outside() const { return places_ - 1; }
  bool stopped() const { return limits_.stop_requested(); }

  // Loads one column per leg. It has a 1 in the row for leaving the first place, in the row for
  // entering the second place and, if both are stops, in the row for this pair.
  void load() {
    std::vector<int> rows;
    std::vector<int> columns;
    std::vector<double> costs;
    const auto add_one = [&](int row) {
      rows.push_back(row);
      columns.push_back(static_cast<int>(legs_.size()));
    };
    for (int i = 0; i < places_; ++i)
      for (int j = 0; j < places_; ++j) {
        if (i == j || matrix_.between(i, j) >= kNever) continue;
        add_one(i);
        add_one(places_ + j);
        if (i != outside() && j != outside())
          add_one(2 * places_ + std::max(i, j) * (std::max(i, j) - 1) / 2 + std::min(i, j));
        legs_.emplace_back(i, j);
        costs.push_back(matrix_.between(i, j));
      }
    const std::vector<double> ones(std::max<std::size_t>(rows.size(), places_ * places_), 1.0);
    const std::vector<double> zeros(legs_.size(), 0.0);
    std::vector<double> least(2 * places_ + outside() * (outside() - 1) / 2, 0.0);
    std::fill_n(least.begin(), 2 * places_, 1.0);
    CoinPackedMatrix matrix(true, rows.data(), columns.data(), ones.data(),
                            static_cast<CoinBigIndex>(rows.size()));
    matrix.setDimensions(static_cast<int>(least.size()), static_cast<int>(legs_.size()));
    solver_.loadProblem(matrix, zeros.data(), ones.data(), costs.data(), least.data(), ones.data());
  }

  void forbid_cycle(StopSet stops) {
    CoinPackedVector row;
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      const auto [from, to] = legs_[i];
      if (from == outside() || to == outside()) continue;
      if ((stops >> from & stops >> to & 1) != 0) row.insert(static_cast<int>(i), 1.0);
    }
    solver_.addRow(row, -solver_.getInfinity(), std::popcount(stops) - 1);
  }

  // Adds the row for every connected component of the legs in the solution that does not contain
  // the outside. Returns true if such a component exists.
  bool cut_off_cycles(const double* x) {
    std::vector<int> component(places_);
    std::iota(component.begin(), component.end(), 0);
    const auto root = [&](int place) {
      while (component[place] != place) place = component[place];
      return place;
    };
    for (std::size_t i = 0; i < legs_.size(); ++i)
      if (x[i] > cbc::kIntegral) component[root(legs_[i].first)] = root(legs_[i].second);
    std::vector<StopSet> members(places_, 0);
    for (int stop = 0; stop < outside(); ++stop) members[root(stop)] |= bit(stop);
    members[root(outside())] = 0;
    bool found = false;
    for (StopSet stops : members) {
      if (stops == 0) continue;
      forbid_cycle(stops);
      found = true;
    }
    return found;
  }

  Outcome branch_and_bound() {
    cbc::IntegerSolution result = cbc::branch_and_bound(solver_, limits_);
    if (result.outcome == Outcome::kOptimal) {
      solution_ = std::move(result.values);
      objective_ = result.objective;
    }
    return result.outcome;
  }

  const CostMatrix& matrix_;
  const Limits& limits_;
  const int places_;
  std::vector<Leg> legs_;  // by variable
  OsiClpSolverInterface solver_;
  std::vector<double> solution_;
  double objective_ = 0;
};

class CbcRtsp : public RtspSolver {
 public:
  CbcRtsp(const CostMatrix& matrix, const Limits& limits)
      : matrix_(matrix), limits_(limits), root_bound_(relaxation_bound(matrix)) {}

  RtspAnswer best(const SequenceClass& sequence_class, Time cutoff) override {
    using Kind = RtspAnswer::Kind;
    const ClassRoot root = class_root(matrix_, sequence_class);
    if (root.left == 0) return remember(sequence_class, sequence_class.prefix);
    const Contracted rest = contract(matrix_, root);
    const Time bound = add_costs(root.cost, relaxation_bound(rest.matrix));
    if (bound >= kNever) return {Kind::kInfeasible, kNever};
    if (bound > cutoff) return {Kind::kAboveCutoff, bound};

    const cbc::SolverLock turn(limits_);
    if (!turn.is_locked()) return {Kind::kStopped, bound};
    PathProgram program(rest.matrix, limits_);
    switch (program.solve()) {
      case PathProgram::Outcome::kStopped:
        return {Kind::kStopped, bound};
      case PathProgram::Outcome::kInfeasible:
        return {Kind::kInfeasible, kNever};
      case PathProgram::Outcome::kOptimal:
        break;
    }
    const Sequence path = program.path();
    if (std::abs(sequence_cost(rest.matrix, path) - program.objective()) > 0.5)
      throw std::runtime_error("CBC returned a wrong cost");
    Sequence sequence = sequence_class.prefix;
    for (Stop stop : path) sequence.push_back(rest.stops[stop]);
    return remember(sequence_class, std::move(sequence));
  }

  Sequence best_sequence(const SequenceClass& sequence_class) override {
    return solved_.at(key(sequence_class));
  }

  Time root_bound() const override { return root_bound_; }

 private:
  using Key = std::pair<std::string, StopSet>;  // prefix, forbidden next stops

  static Key key(const SequenceClass& sequence_class) {
    return {{sequence_class.prefix.begin(), sequence_class.prefix.end()},
            sequence_class.forbidden_next};
  }

  RtspAnswer remember(const SequenceClass& sequence_class, Sequence sequence) {
    const Time cost = sequence_cost(matrix_, sequence);
    if (cost >= kNever) return {RtspAnswer::Kind::kInfeasible, kNever};
    solved_[key(sequence_class)] = std::move(sequence);
    return {RtspAnswer::Kind::kExact, cost};
  }

  const CostMatrix& matrix_;
  const Limits& limits_;
  Time root_bound_;
  std::map<Key, Sequence> solved_;
};

}  // namespace

std::unique_ptr<RtspSolver> make_cbc_rtsp(const CostMatrix& matrix, const Limits& limits) {
  return std::make_unique<CbcRtsp>(matrix, limits);
}

}  // namespace grove::detail
