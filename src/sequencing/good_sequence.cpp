// SPDX-License-Identifier: MIT
#include "sequencing/good_sequence.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {
namespace {

constexpr std::ptrdiff_t kMaxSegment = 3;

class LocalSearch {
 public:
  explicit LocalSearch(const CostMatrix& matrix) : matrix_(min_matrix(matrix)) {}

  Sequence run() {
    insert_all();
    while (improve_by_or_opt() || improve_by_2_opt()) {
    }
    StopSet visited = 0;
    for (const Stop stop : sequence_) visited |= bit(stop);
    GROVE_CHECK(visited == matrix_.all() && std::ssize(sequence_) == matrix_.stops(),
                "a good sequence holds each stop once");
    return sequence_;
  }

 private:
  // Returns the cost of a leg as a 64-bit integer, so that sums with legs of kNever do not
  // overflow: a sequence with more such legs costs more.
  std::int64_t leg(std::ptrdiff_t from, std::ptrdiff_t to) const {
    return matrix_.cost(row(from), row(to));
  }
  // The row of a position. Positions before the first and after the last stop are the start and the
  // end.
  int row(std::ptrdiff_t position) const {
    return position < 0 || position >= std::ssize(sequence_) ? matrix_.stops()
                                                             : sequence_[position];
  }
  std::int64_t leg_to(std::ptrdiff_t from, int stop) const { return matrix_.cost(row(from), stop); }
  std::int64_t leg_from(int stop, std::ptrdiff_t to) const { return matrix_.cost(stop, row(to)); }

  void insert_all() {
    StopSet left = matrix_.all();
    while (left != 0) {
      std::int64_t least = INT64_MAX;
      int best = 0;
      std::ptrdiff_t place = 0;
      for (StopSet rest = left; rest != 0; rest &= rest - 1) {
        const int stop = std::countr_zero(rest);
        for (std::ptrdiff_t at = 0; at <= std::ssize(sequence_); ++at) {
          const std::int64_t replaced = sequence_.empty() ? 0 : leg(at - 1, at);
          const std::int64_t more = leg_to(at - 1, stop) + leg_from(stop, at) - replaced;
          if (more >= least) continue;
          least = more;
          best = stop;
          place = at;
        }
      }
      sequence_.insert(sequence_.begin() + place, static_cast<Stop>(best));
      left &= ~(StopSet{1} << best);
    }
  }

  std::int64_t cost() const {
    std::int64_t sum = 0;
    for (std::ptrdiff_t at = 0; at <= std::ssize(sequence_); ++at) sum += leg(at - 1, at);
    return sum;
  }

  // Makes the first move of a piece that lowers the cost. Returns false if none does.
  bool improve_by_or_opt() {
    const std::ptrdiff_t n = std::ssize(sequence_);
    for (std::ptrdiff_t size = 1; size <= std::min(kMaxSegment, n - 1); ++size)
      for (std::ptrdiff_t begin = 0; begin + size <= n; ++begin) {
        const std::ptrdiff_t end = begin + size;
        const std::int64_t gain = leg(begin - 1, begin) + leg(end - 1, end) - leg(begin - 1, end);
        for (std::ptrdiff_t to = 0; to <= n; ++to) {
          if (to >= begin && to <= end) continue;
          if (leg(to - 1, begin) + leg(end - 1, to) - leg(to - 1, to) >= gain) continue;
          const auto first = sequence_.begin();
          if (to < begin)
            std::rotate(first + to, first + begin, first + end);
          else
            std::rotate(first + begin, first + end, first + to);
          return true;
        }
      }
    return false;
  }

  bool improve_by_2_opt() {
    const std::int64_t before = cost();
    const std::ptrdiff_t n = std::ssize(sequence_);
    for (std::ptrdiff_t begin = 0; begin < n; ++begin)
      for (std::ptrdiff_t end = begin + 2; end <= n; ++end) {
        std::reverse(sequence_.begin() + begin, sequence_.begin() + end);
        if (cost() < before) return true;
        std::reverse(sequence_.begin() + begin, sequence_.begin() + end);
      }
    return false;
  }

  const CostMatrix matrix_;
  Sequence sequence_;
};

}  // namespace

Sequence good_sequence(const CostMatrix& matrix) {
  return LocalSearch(matrix).run();
}

}  // namespace grove::detail
