// SPDX-License-Identifier: MIT
// Tests lower bounds on the legs of a path when cells are barred forever. For each order of the
// stops, the sum of the bounds must not exceed the cost of a path.
#include "planning/late_costs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planning/fixed_order_sipp.h"
#include "tests/planning/free_reference.h"
#include "tests/planning/single_agent.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace late_costs_test {

using testing::grid_of;
using testing::members_of;
using testing::SingleAgent;

class LateCosts {
 public:
  LateCosts(const Grid& grid, Cell start, const std::vector<Cell>& tasks,
            std::optional<Cell> destination)
      : grid_(grid),
        agent_(grid, start, tasks, destination),
        stops_(agent_.instance, agent_.distances, 0),
        intervals_(grid) {}

  int count() const { return stops_.count(); }
  const CostMatrix& plain() const { return stops_.cost_to_go().matrix(); }
  // Returns the cost matrix under these constraints, or the plain one if they raise no cost.
  // `min_cost`: lower bound on the plain cost of every order.
  CostMatrix late(const std::vector<Constraint>& constraints, Time min_cost) {
    intervals_.assign(constraints);
    const auto matrix = late_cost_matrix(grid_, intervals_, stops_, min_cost);
    return matrix ? *matrix : plain();
  }
  // Returns the least cost of a path in this order, or kNever if there is no path.
  Time path_cost(const Sequence& sequence, const std::vector<Constraint>& constraints) {
    const std::vector<TaskIndex> tasks(sequence.begin(), sequence.end());
    FixedOrderSipp search(grid_);
    Path path;
    const auto outcome = search.find(GoalSequence(agent_.instance, agent_.distances, 0, tasks),
                                     {constraints}, Limits(), path);
    return outcome == PathOutcome::kFound ? static_cast<Time>(path.size()) - 1 : kNever;
  }

 private:
  const Grid& grid_;
  SingleAgent agent_;
  AgentStops stops_;
  SafeIntervals intervals_;
};

// A room with one door in the west and one in the east; the destination is inside. The comments
// give the first cell of each row.
const std::vector<std::string> kRoom = {
    "............",  //
    ".@@@@@@@@@@.",  // 12 ..
    ".@........@.",  // 24 ..
    "............",  // 36 ..: doors at 37 and 46
    ".@@@@@@@@@@.",  // 48 ..
};

TEST(LateCosts, LastLegTakesTheDetour) {
  const Grid grid = grid_of(kRoom);
  // From the corner the agent visits (10, 0) and (0, 0) in some order, and then (2, 3).
  LateCosts costs(grid, 48, {10, 0}, 38);
  // 48 -> 0 -> 10 -> 38 costs 4 + 10 + 13, and 48 -> 10 -> 0 -> 38 costs 14 + 10 + 5.
  const Time least = 24;  // a lower bound on both
  const std::vector<Constraint> shut = {{37, kNoCell, 20, kNever}};
  const CostMatrix late = costs.late(shut, least);
  // If stop 1, (0, 0), is last, the agent leaves it at time 24 - 5 = 19 or later. It could
  // therefore reach the west door only at 19 + 4 = 23 or later and must use the east door.
  EXPECT_EQ(costs.plain().to_end(1), 5);
  EXPECT_EQ(late.to_end(1), 11 + 3 + 9);
  // Other legs can start early, so their costs do not change.
  EXPECT_EQ(late.from_start(0), costs.plain().from_start(0));
  EXPECT_EQ(late.between(0, 1), costs.plain().between(0, 1));
  // If the door stays open long enough or opens again, nothing changes.
  EXPECT_EQ(costs.late({{37, kNoCell, 24, kNever}}, least).cost, costs.plain().cost);
  EXPECT_EQ(costs.late({{37, kNoCell, 2, 999}}, least).cost, costs.plain().cost);
}

TEST(LateCosts, StopBehindClosedDoorIsUnreachable) {
  const Grid grid = grid_of({"......"});
  LateCosts costs(grid, 0, {1, 4}, 0);
  const CostMatrix late = costs.late({{3, kNoCell, 2, kNever}}, 8);
  EXPECT_EQ(late.from_start(1), kNever);
  EXPECT_EQ(late.between(0, 1), kNever);
  EXPECT_EQ(late.from_start(0), 1);
  EXPECT_EQ(late.to_end(0), 1);
}

class LateCostsFuzz {
 public:
  explicit LateCostsFuzz(unsigned seed) : random_(seed) {}

  // Adds four constraints one at a time. Returns how often they raised the bound of a sequence; 0
  // if the random problem is too small or has no sequence.
  int check(bool with_destination) {
    const Grid grid = random_grid();
    std::vector<Cell> cells;
    for (Cell cell = 0; cell < grid.cell_count(); ++cell)
      if (grid.passable(cell)) cells.push_back(cell);
    std::ranges::shuffle(cells, random_);
    if (cells.size() < 8) return 0;
    const std::vector<Cell> tasks(cells.begin() + 2, cells.begin() + 2 + 1 + random_() % 4);
    LateCosts costs(grid, cells[0], tasks,
                    with_destination ? std::optional(cells[1]) : std::nullopt);
    const std::vector<Sequence> all = members_of({}, costs.count());
    Time least = kNever;
    for (const Sequence& s : all) least = std::min(least, sequence_cost(costs.plain(), s));
    if (least >= kNever) return 0;
    int raised = 0;
    std::vector<Constraint> constraints;
    for (int k = 0; k < 4; ++k) {
      const auto begin = static_cast<Time>(random_() % static_cast<unsigned>(least + 4));
      const Time end = random_() % 4 == 0 ? begin + 3 : kNever;
      constraints.push_back({cells[random_() % cells.size()], kNoCell, begin, end});
      const CostMatrix late = costs.late(constraints, least - static_cast<Time>(random_() % 2));
      for (int from = 0; from < late.cost.size(); ++from)
        for (int to = 0; to < late.cost.size(); ++to)
          EXPECT_GE(late.cost(from, to), costs.plain().cost(from, to));
      for (const Sequence& s : all) {
        const Time bound = sequence_cost(late, s);
        EXPECT_LE(bound, costs.path_cost(s, constraints)) << k;
        raised += bound > sequence_cost(costs.plain(), s);
      }
    }
    return raised;
  }

 private:
  Grid random_grid() {
    const int width = 3 + static_cast<int>(random_() % 5);
    const int height = 3 + static_cast<int>(random_() % 5);
    std::vector<bool> passable(width * height);
    for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = random_() % 4 > 0;
    return {width, height, passable};
  }

  std::mt19937 random_;
};

TEST(LateCosts, NeverExceedTheCostOfAPath) {
  int raised = 0;
  for (int seed = 0; seed < testing::fuzz_rounds(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    raised += LateCostsFuzz(static_cast<unsigned>(seed)).check(seed % 2 == 0);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(raised, 1000);
}

}  // namespace late_costs_test
}  // namespace grove::detail
