// SPDX-License-Identifier: MIT
// The Held-Karp table. The head of held_karp.cpp describes its recursion.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "model/limits.h"
#include "model/shared_arrays.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/sequence.h"

namespace grove::detail {

inline constexpr int kMaxTableStops = 26;  // 3.5 GB of 16-bit entries; no caller needs more

// Entry of an unreachable state. Twice this value fits into an Entry, so no sum of two entries
// overflows. Every true cost is less.
template <class Entry>
inline constexpr Entry kUnreachable = std::numeric_limits<Entry>::max() / 2;

// Returns an upper bound on every finite cost of a sequence, because a sequence has at most one leg
// from each row of the matrix.
inline std::int64_t max_cost(const CostMatrix& matrix) {
  std::int64_t sum = 0;
  for (int row = 0; row < matrix.cost.size(); ++row) {
    Time most = 0;
    for (int column = 0; column < matrix.cost.size(); ++column)
      if (const Time cost = matrix.cost(row, column); cost < kNever) most = std::max(most, cost);
    sum += most;  // includes all ports of a stop, although a sequence uses one
  }
  return sum;
}

// True if every cost fits a table with 16-bit entries.
inline bool fits_narrow_table(const CostMatrix& matrix) {
  return max_cost(matrix) < kUnreachable<std::int16_t>;
}

// Costs to go h[left][port]; for ports see CostMatrix. Immutable after build(): any thread may read
// it.
template <class Entry>
class HeldKarpTable {
 public:
  bool built() const { return table_ != nullptr; }

  // Number of entries of a table, including space for full vectors after the last row. 0: the table
  // would be too large.
  static std::size_t entries(int stops, int ports) {
    const int width = stops * ports;
    return stops > kMaxTableStops || width > kMaxLanes * kLanes
               ? 0
               : (std::size_t{1} << stops) * width + kMaxLanes * kLanes;
  }

  // Builds the table, in `shared` if that has room. Returns false, and builds nothing, if a limit
  // was reached, the table would be too large or memory is not available.
  bool build(const CostMatrix& matrix, const Limits& limits, SharedArray shared = {}) {
    stops_ = matrix.stops();
    ports_ = matrix.ports;
    const std::size_t bytes = entries(stops_, ports_) * sizeof(Entry);
    if (limits.stop_requested()) return false;
    if (bytes > 0 && shared.has_room(bytes))
      table_ = reinterpret_cast<const Entry*>(shared.get(limits, [&](std::byte* begin) {
        return fill(reinterpret_cast<Entry*>(begin), matrix, limits);
      }));
    if (table_) return true;
    if (bytes == 0 || !limits.memory_allows(bytes) || !allocate(bytes / sizeof(Entry))) {
      limits.memory_exhausted();
      return false;
    }
    if (fill(own_.get(), matrix, limits))
      table_ = own_.get();
    else
      own_.reset();
    return built();
  }

  // The least cost from `port` through all stops of `left` to the end; kNever if no such route
  // exists. Requires built().
  Time cost_to_go(StopSet left, int port) const {
    const Entry cost = table_[left * static_cast<StopSet>(stops_ * ports_) + port];
    return cost == kUnreachable<Entry> ? kNever : Time{cost};
  }

 private:
  static constexpr int kLanes = 8;
  static constexpr int kMaxLanes = 7;                   // 14 stops of four ports
  static constexpr std::uint32_t kPollInterval = 4096;  // rows, together about 0.2 ms

  bool allocate(std::size_t entries) {
    own_.reset(new (std::nothrow) Entry[entries]);
    return own_ != nullptr;
  }

  // Returns false if a limit was reached.
  bool fill(Entry* table, const CostMatrix& matrix, const Limits& limits) const {
    return ports_ == 1 ? fill_lanes<1>(table, matrix, limits)
                       : fill_lanes<4>(table, matrix, limits);
  }

  // Fills the table with the least number of vectors that holds a row.
  template <int kPorts, int kCount = 1>
  bool fill_lanes(Entry* table, const CostMatrix& matrix, const Limits& limits) const {
    if constexpr (kCount < kMaxLanes)
      if (stops_ * kPorts > kCount * kLanes)
        return fill_lanes<kPorts, kCount + 1>(table, matrix, limits);
    return fill_wide<kPorts, kCount * kLanes>(table, matrix, limits);
  }

  template <int kPorts, int kWidth>
  bool fill_wide(Entry* table, const CostMatrix& matrix, const Limits& limits) const {
    const int n = stops_ * kPorts;
    const std::vector<Entry> into = columns(matrix, kWidth);
    for (int v = 0; v < n; ++v) table[v] = entry(matrix.to_end(v));
    for (std::uint32_t set = 1; set < std::uint32_t{1} << stops_; ++set) {
      if (set % kPollInterval == 0 && limits.stop_requested()) return false;
      Entry row[kWidth];
      std::fill_n(row, kWidth, kUnreachable<Entry>);
      for_each_stop(set, [&](int stop) {
        for (int u = stop * kPorts; u < (stop + 1) * kPorts; ++u) {
          const Entry rest = table[(set & ~bit(stop)) * n + u];
          const Entry* leg = &into[static_cast<std::size_t>(u) * kWidth];
          for (int v = 0; v < kWidth; ++v)
            row[v] = std::min(row[v], static_cast<Entry>(leg[v] + rest));
        }
      });
      std::copy_n(row, kWidth, &table[std::size_t{set} * n]);
    }
    return true;
  }

  // Returns the cost matrix by columns: entry u * width + v is the leg from port v to port u.
  static std::vector<Entry> columns(const CostMatrix& matrix, int width) {
    const int n = matrix.stops() * matrix.ports;
    std::vector<Entry> into(static_cast<std::size_t>(n) * width, kUnreachable<Entry>);
    for (int u = 0; u < n; ++u)
      for (int v = 0; v < n; ++v) into[u * width + v] = entry(matrix.between(v, u));
    return into;
  }

  static Entry entry(Time cost) {
    return cost >= kNever ? kUnreachable<Entry> : static_cast<Entry>(cost);
  }

  int stops_ = 0;
  int ports_ = 1;
  const Entry* table_ = nullptr;  // in own_ or in shared memory
  std::unique_ptr<Entry[]> own_;
};

}  // namespace grove::detail
