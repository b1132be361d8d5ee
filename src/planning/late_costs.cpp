// SPDX-License-Identifier: MIT
// Target reasoning and long bans leave cells barred for ever from some time on. Distances on the
// bare map do not know of that, so a search under them sees no reason not to try every order whose
// cost is below that of the way around. Here legs that surely begin late go around.
//
// *Claim: a leg that leaves stop i at time e or later takes at least depth(j) steps to reach j*,
// where depth is breadth-first search from i that enters a cell c only if e + depth(c) <= last(c),
// the last time at which anybody may be on c. Let c_0 = i, c_1, .. be the cells of the leg, a step
// each, begun at t >= e. depth(c_k) <= k by induction: c_k is occupied at t + k, so
// e + depth(c_{k-1}) + 1 <= e + k <= t + k <= last(c_k), and the search enters it by depth k.
//
// How late: nobody counts stop i before dist(start, i). And of a path that counts i last, with a
// sequence s, the way up to i visits all of s, so it takes at least cost(s) - to_end(i), and
// cost(s) is at least the least cost of all sequences in question: the leg from i to the end begins
// at least_cost - to_end(i) or later. Costs are those without constraints on both sides.
//
// Since each leg of a path costs at least its entry, whatever comes before and after, the matrix
// serves as the plain one does: it bounds the whole sequence, and what is left of it from any
// state.
#include "late_costs.h"

#include <algorithm>
#include <vector>

namespace grove {
namespace {

class LateCosts {
 public:
  LateCosts(const Grid& grid, SafeIntervals& intervals, const AgentStops& stops)
      : grid_(grid), stops_(stops), matrix_(stops.completions().matrix()) {
    last_.resize(static_cast<std::size_t>(grid.cell_count()), kNever);
    for (Cell cell = 0; cell < grid.cell_count(); ++cell) {
      if (!grid.passable(cell)) continue;
      intervals.see(cell);
      last_[cell] = intervals.last_time(cell);
      if (last_[cell] < kNever) barred_.push_back(cell);
    }
  }

  std::optional<CostMatrix> raise(Time least_cost) {
    if (barred_.empty()) return std::nullopt;
    const int n = stops_.count();
    for (int stop = 0; stop < n; ++stop) {
      const Time begin = stops_.distances_from(stops_.start())[stop];
      raise_row(stop, stops_.cell(stop), begin);
      if (stops_.destination())
        raise_last_leg(stop, std::max(begin, least_cost - matrix_.to_end(stop)));
    }
    raise_row(n, stops_.start(), 0);
    return raised_ ? std::optional(std::move(matrix_)) : std::nullopt;
  }

 private:
  // The legs from `from`, a row of the matrix, to the other stops.
  void raise_row(int row, Cell from, Time begin) {
    if (row < stops_.count() && !is_late(row, begin)) return;
    walk(from, begin);
    for (int stop = 0; stop < stops_.count(); ++stop) raise_to(row, stop, stops_.cell(stop));
  }

  void raise_last_leg(int stop, Time begin) {
    if (!is_late(stop, begin)) return;
    walk(stops_.cell(stop), begin);
    raise_to(stop, stops_.count(), *stops_.destination());
  }

  void raise_to(int row, int column, Cell cell) {
    Time& cost = matrix_.cost(row, column);
    if (row == column || depth_[cell] <= cost) return;
    cost = depth_[cell];
    raised_ = true;
  }

  // Does a leg from a stop, begun then, come too late for a cell?
  bool is_late(int stop, Time begin) const {
    return std::ranges::any_of(barred_, [&](Cell cell) {
      const Time there = stops_.distances_from(cell)[stop];
      return there < kNever && begin + there > last_[cell];
    });
  }

  // Depths from a cell that the agent is on, kNever where it does not come.
  void walk(Cell from, Time begin) {
    depth_.assign(last_.size(), kNever);
    depth_[from] = 0;
    queue_.assign(1, from);
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const Time depth = depth_[queue_[next]] + 1;
      for (Cell cell : grid_.neighbors(queue_[next]))
        if (depth < depth_[cell] && begin + depth <= last_[cell]) {
          depth_[cell] = depth;
          queue_.push_back(cell);
        }
    }
  }

  const Grid& grid_;
  const AgentStops& stops_;
  CostMatrix matrix_;
  bool raised_ = false;
  std::vector<Time> last_;  // by cell
  std::vector<Cell> barred_;
  std::vector<Time> depth_;  // by cell
  std::vector<Cell> queue_;
};

}  // namespace

std::optional<CostMatrix> late_cost_matrix(const Grid& grid, SafeIntervals& intervals,
                                           const AgentStops& stops, Time least_cost) {
  return LateCosts(grid, intervals, stops).raise(least_cost);
}

}  // namespace grove
