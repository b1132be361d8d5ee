// SPDX-License-Identifier: MIT
// Solves rTSPs with the Held-Karp table.
//
// Held and Karp (1962), backwards: h[S][v] is the least cost from stop v through all stops of S (v
// not in S) to the end,
//
//   h[{}][v] = cost(v, end),   h[S][v] = min over u in S of cost(v, u) + h[S - u][u].
//
// The recursion considers all orders of S, so h is exact. The cost of the best member of a class is
// that of its prefix plus the least cost(last, u) + h[left - u][u] over the next stops u that the
// class allows, which takes O(n) per query after the table is built. The recursion runs backwards
// because the partition method fixes prefixes.
//
// *Cost.* 2^n * n^2 / 2 additions. For each S the loop over u is the outer one and the loop over v
// the inner one, so that the compiler vectorizes the inner loop as minima over a row. If every cost
// of a sequence fits, entries have 16 bits: one SSE2 instruction then processes eight stops, and
// the table takes half the memory. Rows have no padding. Each row is written at full vector width,
// and the next row overwrites the excess, because S ascends.
#include "model/assert.h"
#include "sequencing/held_karp_table.h"
#include "sequencing/rtsp.h"
#include "sequencing/sequence_class.h"

namespace grove::detail {
namespace {

template <class Entry>
class HeldKarp : public RtspSolver {
 public:
  HeldKarp(const CostMatrix& matrix, const Limits& limits)
      : matrix_(matrix), limits_(limits), root_bound_(relaxation_bound(matrix)) {}

  RtspAnswer best(const SequenceClass& sequence_class, Time) override {
    if (!table_.built() && !table_.build(matrix_, limits_))
      return {RtspAnswer::Kind::kStopped, root_bound_};
    const Time cost = best_cost(matrix_, class_root(matrix_, sequence_class), cost_to_go());
    GROVE_CHECK(cost >= root_bound_, "no sequence costs less than the relaxation");
    if (cost >= kNever) return {RtspAnswer::Kind::kInfeasible, kNever};
    return {RtspAnswer::Kind::kExact, cost};
  }

  Sequence best_sequence(const SequenceClass& sequence_class) override {
    return best_member(matrix_, sequence_class, cost_to_go());
  }

  Time root_bound() const override { return root_bound_; }

 private:
  auto cost_to_go() const {
    return [this](StopSet left, int stop) { return table_.cost_to_go(left, stop); };
  }

  const CostMatrix& matrix_;
  const Limits& limits_;
  Time root_bound_;
  HeldKarpTable<Entry> table_;
};

}  // namespace

std::unique_ptr<RtspSolver> make_held_karp(const CostMatrix& matrix, const Limits& limits) {
  if (fits_narrow_table(matrix)) return std::make_unique<HeldKarp<std::int16_t>>(matrix, limits);
  return std::make_unique<HeldKarp<std::int32_t>>(matrix, limits);
}

}  // namespace grove::detail
