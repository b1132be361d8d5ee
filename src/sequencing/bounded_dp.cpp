// SPDX-License-Identifier: MIT
// Bounded dynamic programming for rTSPs, over a sequence graph that grows on demand.
//
// *Exactness.* The graph (sequence_dag.cpp) holds every sequence cheaper than its outside_bound().
// Let `value` be the cost of the best member of a class inside the graph, kNever if there is none.
// If finite, it is the cost of a sequence of the class, and every member outside the graph costs at
// least outside_bound(). So if value <= outside_bound(), `value` is optimal. Otherwise the optimum
// is at least outside_bound(). If outside_bound() exceeds the cutoff, the query is answered;
// otherwise the graph is rebuilt with a greater cost limit.
//
// *Growth.* The increase of the limit affects only speed, as in iterative deepening with controlled
// growth (Sarkar et al. 1991). It is chosen to admit about as many new states as the graph already
// has, so that all builds together cost little more than the last one. The method needs no
// heuristic upper bound: the first limit is the bound of the relaxation, and the graph stops
// growing as soon as the query is answered.
//
// *Relaxation.* The relaxation of the class is tried first. It decides many classes above the
// cutoff without a graph, so that such a class does not enlarge the graph that all classes share.
//
// *Canonical sequences.* If many stops are in a row, a huge number of sequences can have the same
// cost, and no graph can hold all of them. If the graph exceeds max_states_, a graph of the
// canonical sequences (passed_stops.cpp) of the queried class replaces it. This graph is built
// separately for each class. A query needs only a cheapest member of its class, and at least one is
// canonical. If the second graph becomes too large as well, the answer is kStopped for this class
// and for every later class that the relaxation does not decide, so that no more memory is spent.
//
// *Measured* on 32x32 maps and den312d, CTS and MG, one core: the best sequence of 36 stops takes 2
// to 120 ms, with graphs of at most 2,800 states.
#include <optional>

#include "model/assert.h"
#include "sequencing/one_tree_relaxation.h"
#include "sequencing/passed_stops.h"
#include "sequencing/rtsp.h"
#include "sequencing/sequence_class.h"
#include "sequencing/sequence_dag.h"

namespace grove::detail {
namespace {

class BoundedDp : public RtspSolver {
  auto cost_to_go() const {
    return [this](StopSet left, int stop) { return dag_.cost_to_go(left, stop); };
  }

 public:
  BoundedDp(const CostMatrix& matrix, const Limits& limits, std::size_t max_states)
      : matrix_(matrix),
        limits_(limits),
        max_states_(max_states),
        relaxation_(matrix),
        dag_(relaxation_.root_bound()) {}

  RtspAnswer best(const SequenceClass& sequence_class, Time cutoff) override {
    using Kind = RtspAnswer::Kind;
    const ClassRoot root = class_root(matrix_, sequence_class);
    const Time relaxed = class_bound(root);
    set_class(sequence_class, relaxed);
    while (true) {
      const Time value = best_cost(matrix_, root, cost_to_go());
      const Time bound = std::max(relaxed, dag_.outside_bound());
      GROVE_CHECK(value >= relaxed, "no sequence costs less than the relaxation");
      if (value <= bound) return {value < kNever ? Kind::kExact : Kind::kInfeasible, value};
      if (bound > cutoff) return {Kind::kAboveCutoff, bound};
      if (!extend()) return {Kind::kStopped, bound};
    }
  }

  Sequence best_sequence(const SequenceClass& sequence_class) override {
    if (passed_ && sequence_class != class_) best(sequence_class, kNever);
    return best_member(matrix_, sequence_class, cost_to_go());
  }

  Time root_bound() const override { return relaxation_.root_bound(); }

 private:
  using End = SequenceDag::End;
  static constexpr std::size_t kMaxCanonicalStates = std::size_t{1} << 21;

  // Returns the bound of the relaxation on a class. It is exact for a class with a complete prefix,
  // and kNever for a class that allows no next stop.
  Time class_bound(const ClassRoot& root) const {
    if (root.left == 0) return add_costs(root.cost, matrix_.to_end(root.last));
    if (root.next == 0) return kNever;
    return add_costs(root.cost,
                     relaxation_.bound(relaxation_.tail(root.left), root.next, root.last));
  }

  // Changes the class. A graph of canonical sequences is valid for one class only, so it is
  // discarded.
  void set_class(const SequenceClass& sequence_class, Time relaxed) {
    if (sequence_class == class_) return;
    class_ = sequence_class;
    if (passed_) dag_ = SequenceDag(relaxed);
  }

  bool extend() {
    if (!passed_) {
      const End end =
          build({.matrix = matrix_, .relaxation = relaxation_, .max_states = max_states_});
      if (end != End::kTooLarge || matrix_.ports > 1) return end == End::kBuilt;
      passed_.emplace(matrix_);
      dag_ = SequenceDag(dag_.outside_bound());
    }
    if (too_large_) return false;
    const End end = build({.matrix = matrix_,
                           .relaxation = relaxation_,
                           .passed = &*passed_,
                           .sequence_class = class_,
                           .max_states = kMaxCanonicalStates});
    too_large_ = end == End::kTooLarge;
    return end == End::kBuilt;
  }
  End build(const SequenceDag::Scope& scope) {
    GROVE_CHECK(dag_.next_cost_limit() >= dag_.outside_bound(),
                "the next graph holds a sequence that is outside the graph");
    return SequenceDag::build(scope, dag_.next_cost_limit(), limits_, dag_);
  }

  const CostMatrix& matrix_;
  const Limits& limits_;
  const std::size_t max_states_;  // size limit of the graph of all sequences
  OneTreeRelaxation relaxation_;
  SequenceDag dag_;
  std::optional<PassedStops> passed_;  // set after the graph of all sequences was too large
  SequenceClass class_;                // class of the graph of canonical sequences
  bool too_large_ = false;
};

}  // namespace

std::unique_ptr<RtspSolver> make_bounded_dp(const CostMatrix& matrix, const Limits& limits,
                                            std::size_t max_states) {
  return std::make_unique<BoundedDp>(matrix, limits, max_states);
}

}  // namespace grove::detail
