// SPDX-License-Identifier: MIT
// The Held-Karp table.
//
// Held and Karp (1962), run backwards: h[S][v] is the least cost from stop v through all stops of S
// (v not among them) to the end,
//
//   h[{}][v] = cost(v, end),   h[S][v] = min over u in S of cost(v, u) + h[S - u][u].
//
// The recursion ranges over all orders of S, so h is exact, and the best member of a class costs
// its prefix plus the least of cost(last, u) + h[left - u][u] over the next stops u it allows: O(n)
// per question once the table stands. That is why the table runs backwards: the partition method
// fixes prefixes.
//
// Time is 2^n * n^2 / 2 additions. For each S the loop over u is outside and the one over v inside,
// so that the compiler turns the latter into vector minima over a row; 16-bit entries, wherever
// every cost of a sequence fits, make that eight stops per SSE2 instruction and halve the memory.
// Rows lie one behind the other without padding: a row is stored at full vector width, and what
// spills over is overwritten by the next row, since S ascends.
#include <limits>
#include <new>

#include "rtsp_backends.h"
#include "sequence_class.h"

namespace grove {
namespace {

constexpr int kMostStops = 26;  // 3.5 GB; a table beyond is nobody's wish
constexpr int kLanes = 8;
constexpr std::uint32_t kPollInterval = 4096;  // rows, together about 0.2 ms

// Twice this value still fits, so that no sum overflows; every true cost is below it.
template <class Entry>
constexpr Entry kNoWay = std::numeric_limits<Entry>::max() / 2;

// Every row has one leg in a sequence, so no finite cost of a sequence exceeds this.
std::int64_t most_expensive(const CostMatrix& matrix) {
  std::int64_t sum = 0;
  for (Eigen::Index row = 0; row < matrix.cost.rows(); ++row) {
    Time most = 0;
    for (Time cost : matrix.cost.row(row))
      if (cost < kNever) most = std::max(most, cost);
    sum += most;
  }
  return sum;
}

template <class Entry>
class HeldKarp : public RtspSolver {
 public:
  HeldKarp(const CostMatrix& matrix, const Limits& limits)
      : matrix_(matrix), limits_(limits), root_bound_(relaxation_bound(matrix)) {}

  RtspAnswer best(const SequenceClass& work, Time) override {
    if (!table_ && !build()) return {RtspAnswer::Kind::kStopped, root_bound_};
    const Time cost = best_cost(matrix_, class_root(matrix_, work), completion());
    if (cost >= kNever) return {RtspAnswer::Kind::kInfeasible, kNever};
    return {RtspAnswer::Kind::kExact, cost};
  }

  Sequence best_sequence(const SequenceClass& work) override {
    return best_member(matrix_, work, completion());
  }

  Time root_bound() const override { return root_bound_; }

 private:
  auto completion() const {
    return [this](StopSet left, int stop) {
      const Entry cost = table_[left * static_cast<StopSet>(matrix_.stops()) + stop];
      return cost == kNoWay<Entry> ? kNever : Time{cost};
    };
  }

  bool build() {
    const int n = matrix_.stops();
    const std::size_t entries = n > kMostStops ? 0 : (std::size_t{1} << n) * n + 4 * kLanes;
    if (limits_.stop_requested()) return false;
    if (entries == 0 || !limits_.memory_allows(entries * sizeof(Entry)) || !allocate(entries)) {
      limits_.memory_exhausted();
      return false;
    }
    const bool complete = n <= kLanes       ? fill<kLanes>()
                          : n <= 2 * kLanes ? fill<2 * kLanes>()
                          : n <= 3 * kLanes ? fill<3 * kLanes>()
                                            : fill<4 * kLanes>();
    if (!complete) table_.reset();
    return complete;
  }

  bool allocate(std::size_t entries) {
    table_.reset(new (std::nothrow) Entry[entries]);
    return table_ != nullptr;
  }

  template <int kWidth>
  bool fill() {
    const int n = matrix_.stops();
    const std::vector<Entry> into = columns(kWidth);
    for (int v = 0; v < n; ++v) table_[v] = entry(matrix_.to_end(v));
    for (std::uint32_t set = 1; set < std::uint32_t{1} << n; ++set) {
      if (set % kPollInterval == 0 && limits_.stop_requested()) return false;
      Entry row[kWidth];
      std::fill_n(row, kWidth, kNoWay<Entry>);
      for_each_stop(set, [&](int u) {
        const Entry rest = table_[(set & ~bit(u)) * n + u];
        const Entry* leg = &into[static_cast<std::size_t>(u) * kWidth];
        for (int v = 0; v < kWidth; ++v)
          row[v] = std::min(row[v], static_cast<Entry>(leg[v] + rest));
      });
      std::copy_n(row, kWidth, &table_[std::size_t{set} * n]);
    }
    return true;
  }

  // The cost matrix by columns: entry u * width + v is the leg from v to u.
  std::vector<Entry> columns(int width) const {
    const int n = matrix_.stops();
    std::vector<Entry> into(static_cast<std::size_t>(n) * width, kNoWay<Entry>);
    for (int u = 0; u < n; ++u)
      for (int v = 0; v < n; ++v) into[u * width + v] = entry(matrix_.between(v, u));
    return into;
  }

  static Entry entry(Time cost) {
    return cost >= kNever ? kNoWay<Entry> : static_cast<Entry>(cost);
  }

  const CostMatrix& matrix_;
  const Limits& limits_;
  Time root_bound_;
  std::unique_ptr<Entry[]> table_;
};

}  // namespace

std::unique_ptr<RtspSolver> make_held_karp(const CostMatrix& matrix, const Limits& limits) {
  if (most_expensive(matrix) < kNoWay<std::int16_t>)
    return std::make_unique<HeldKarp<std::int16_t>>(matrix, limits);
  return std::make_unique<HeldKarp<std::int32_t>>(matrix, limits);
}

}  // namespace grove
