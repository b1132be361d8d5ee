// SPDX-License-Identifier: MIT
// Canonical sequences: a subset of the sequences of a class that contains an optimum.
//
// *Problem.* If many stops are in a row, a sequence can visit each of them on the way in or on the
// way out, at the same cost. For the optimum, one of these sequences is sufficient.
//
// *Definitions.* Let detour(v, u, w) = cost(v, u) + cost(u, w) - cost(v, w), where v is a stop or
// the start, and w a stop or the end. Let least(u) be the least detour of u over all such v and w.
// Stop u *is passed* on the leg from v to a stop w if detour(v, u, w) = least(u) and (cost(v, u),
// u) < (cost(v, w), w), in lexicographic order. A sequence of a class is *canonical* if no leg
// after its first free stop passes a stop that comes later in the sequence.
//
// *Claim: each class with a sequence of finite cost has a cheapest member that is canonical.*
// *Proof.* Take a cheapest member, and the first leg (v, w) that passes a later stop u. Move u
// between v and w. This removes a detour of least(u) or more, and adds a detour of least(u), so the
// sequence costs no more. The prefix and the first free stop do not change, so the sequence is in
// the class. The successor of v is now smaller in the order above, and the legs before v are
// unchanged. Since the number of stops is finite, after finitely many moves the leg from v passes
// no later stop, and later moves do not change this leg. The same argument then applies to the next
// leg, and so on. (If no leg from x to y exists, but legs from x to u and from u to y do, the
// detour is far below zero, and so is least(u). Then no leg of a sequence of finite cost passes u.)
#include "sequencing/passed_stops.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "sequencing/sequence.h"

namespace grove::detail {

PassedStops::PassedStops(const CostMatrix& matrix)
    : stops_(matrix.stops()), passed_(static_cast<std::size_t>((stops_ + 1) * stops_), 0) {
  const int n = stops_;
  constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
  const auto detour = [&](int from, int by, int to) {
    const std::int64_t there = matrix.cost(from, by);
    const std::int64_t on = matrix.cost(by, to);
    return there >= kNever || on >= kNever ? kNone : there + on - matrix.cost(from, to);
  };
  const auto nearness = [&](int from, int to) { return std::pair(matrix.cost(from, to), to); };
  for (int stop = 0; stop < n; ++stop) {
    std::int64_t least = kNone;
    for (int from = 0; from <= n; ++from)
      for (int to = 0; to <= n; ++to)
        if (from != stop && to != stop && (from != to || from == n))
          least = std::min(least, detour(from, stop, to));
    if (least == kNone) continue;
    for (int from = 0; from <= n; ++from)
      for (int to = 0; to < n; ++to) {
        if (from == stop || to == stop || from == to) continue;
        if (matrix.cost(from, to) < kNever && detour(from, stop, to) == least &&
            nearness(from, stop) < nearness(from, to))
          passed_[static_cast<std::size_t>(from * n + to)] |= bit(stop);
      }
  }
}

}  // namespace grove::detail
