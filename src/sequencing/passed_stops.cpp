// SPDX-License-Identifier: MIT
// Canonical sequences: a restriction that keeps an optimum.
//
// *Problem.* If many stops lie in a row, a sequence may visit each of them on the way in or on the
// way out, at the same cost. One of all these sequences is enough for an optimum.
//
// *Definitions.* Let detour(v, u, w) = cost(v, u) + cost(u, w) - cost(v, w), where v is a stop or
// the start, and w a stop or the end. Let least(u) be the least detour of u over all such v and w.
// Stop u *is passed* on the leg from v to a stop w if detour(v, u, w) = least(u) and (cost(v, u),
// u) < (cost(v, w), w), in lexicographic order. A sequence of a class is *canonical* if none of its
// legs after the first free stop passes a stop that comes later.
//
// *Claim: each class with a sequence of finite cost has a cheapest member that is canonical.*
// Proof: take a cheapest member, and the first leg (v, w) that passes a later stop u. Move u
// between v and w. This removes a detour of least(u) or more, and adds a detour of least(u), so the
// sequence costs no more. The prefix and the first free stop remain, so the sequence is of the
// class. The successor of v is now smaller in the order above, and the legs before v have not
// changed. That order is finite, so after finitely many moves the leg from v passes no later stop,
// and no later move changes this leg. Then the same argument applies to the next leg, and so on.
// (If a leg from x to y does not exist, but one from x over u to y does, the detour is far below
// zero. Then so is least(u), and no leg of a sequence of finite cost has that detour.)
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
