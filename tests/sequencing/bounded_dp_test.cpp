// SPDX-License-Identifier: MIT
// Tests the sequence graph: its costs are exact, and its bound on all other sequences is proven.
// rtsp_test.cpp compares small instances with brute force. This file tests the relaxation state by
// state, compares the graph with Held-Karp, and covers sizes beyond the reach of any table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "brute_force.h"
#include "matrices.h"
#include "sequencing/cost_to_go.h"
#include "sequencing/k_best_sequences.h"
#include "sequencing/one_tree_relaxation.h"
#include "sequencing/sequence_dag.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail::testing {
namespace bounded_dp_test {

std::vector<CostMatrix> matrices_of(int n, Variant variant, Random& random) {
  return {grid_matrix(n, variant, random), metric_matrix(n, variant, random),
          wild_matrix(n, variant, random), turning_matrix(n, variant, random),
          wild_port_matrix(n, variant, random)};
}

// Calls visit(port) for every port of every stop in `set`.
template <class Visit>
void for_each_port(const CostMatrix& matrix, StopSet set, Visit visit) {
  for_each_stop(set, [&](int stop) {
    for (int port = stop * matrix.ports; port < (stop + 1) * matrix.ports; ++port) visit(port);
  });
}

StopSet stop_of(const CostMatrix& matrix, int port) {
  return bit(port / matrix.ports);
}

// Returns the least cost from row `at` through all stops of `left` to the end, by enumeration.
Time cheapest_rest(const CostMatrix& matrix, StopSet left, int at) {
  if (left == 0) return matrix.to_end(at);
  Time best = kNever;
  for_each_port(matrix, left, [&](int next) {
    best = std::min(best, add_costs(matrix.between(at, next),
                                    cheapest_rest(matrix, left & ~stop_of(matrix, next), next)));
  });
  return best;
}

TEST(OneTreeRelaxation, BoundsEveryState) {
  Random random(31);
  for (int round = 0; round < fuzz_rounds(15); ++round)
    for (Variant variant : kVariants)
      for (int n = 1; n <= 6; ++n)
        for (const CostMatrix& matrix : matrices_of(n, variant, random)) {
          if (matrix.ports > 1 && n > 3) continue;
          const OneTreeRelaxation relaxation(matrix);
          for (StopSet left = 1; left <= matrix.all(); ++left)
            for (int at = 0; at <= n * matrix.ports; ++at) {
              if (at < n * matrix.ports && (left & stop_of(matrix, at)) != 0) continue;
              ASSERT_LE(relaxation.bound(relaxation.tail(left), left, at),
                        cheapest_rest(matrix, left, at));
            }
        }
}

// Enumerates all orders of the stops in `left` and all choices of a port for each stop. Calls
// visit(cost) for each choice that costs at most `cost_limit` and whose states all satisfy
// `may_pass`.
template <class MayPass, class Visit>
void walk(const CostMatrix& matrix, StopSet left, int at, Time cost, Time cost_limit,
          const MayPass& may_pass, const Visit& visit) {
  if (left == 0) {
    if (add_costs(cost, matrix.to_end(at)) <= cost_limit) visit(cost + matrix.to_end(at));
    return;
  }
  for_each_port(matrix, left, [&](int next) {
    const StopSet after = left & ~stop_of(matrix, next);
    const Time here = add_costs(cost, matrix.between(at, next));
    if (here <= cost_limit && may_pass(after, next, here))
      walk(matrix, after, next, here, cost_limit, may_pass, visit);
  });
}

template <class MayPass>
std::vector<Time> costs_of_walks(const CostMatrix& matrix, Time cost_limit,
                                 const MayPass& may_pass) {
  std::vector<Time> costs;
  walk(matrix, matrix.all(), matrix.stops() * matrix.ports, 0, cost_limit, may_pass,
       [&](Time cost) { costs.push_back(cost); });
  std::sort(costs.begin(), costs.end());
  return costs;
}

std::vector<Time> costs_within(const SequenceDag& dag, const CostMatrix& matrix, Time cost_limit) {
  return costs_of_walks(matrix, cost_limit, [&](StopSet left, int port, Time cost) {
    return add_costs(cost, dag.cost_to_go(left, port)) <= cost_limit;
  });
}

TEST(SequenceDag, HoldsExactlyTheSequencesBelowItsBound) {
  Random random(32);
  const Limits limits;
  for (int round = 0; round < fuzz_rounds(10); ++round)
    for (Variant variant : kVariants)
      for (int n = 1; n <= 7; ++n)
        for (const CostMatrix& matrix : matrices_of(n, variant, random)) {
          if (matrix.ports > 1 && n > 4) continue;
          const std::vector<Time> all =
              costs_of_walks(matrix, kNever - 1, [](auto...) { return true; });
          if (all.empty()) continue;
          const OneTreeRelaxation relaxation(matrix);
          for (Time slack : {-1, 0, 1, 5}) {
            const Time cost_limit = all.front() + slack;
            const auto dag = SequenceDag::build(matrix, relaxation, cost_limit, limits);
            ASSERT_TRUE(dag);
            ASSERT_GT(dag->outside_bound(), cost_limit);
            const Time below = std::min(dag->outside_bound(), kNever) - 1;
            const auto end = std::upper_bound(all.begin(), all.end(), below);
            ASSERT_EQ(costs_within(*dag, matrix, below), std::vector(all.begin(), end));
          }
        }
}

// For every set of stops and every port in it, the bound from this port through the other stops
// must not exceed the least cost over all orders.
TEST(OneTreeRelaxation, TreeOfSetBoundsPathsThatBeginInIt) {
  Random random(34);
  int above_zero = 0;
  for (int round = 0; round < fuzz_rounds(10); ++round)
    for (Variant variant : kVariants)
      for (int n : {3, 6})
        for (const CostMatrix& matrix : matrices_of(n, variant, random)) {
          if (matrix.ports > 1 && n > 3) continue;
          const OneTreeRelaxation relaxation(matrix);
          for (StopSet left = 1; left <= matrix.all(); ++left) {
            const OneTreeRelaxation::Tail tail = relaxation.tail(left);
            for_each_port(matrix, left, [&](int first) {
              const Time bound = relaxation.bound_from(tail, first);
              ASSERT_LE(bound, cheapest_rest(matrix, left & ~stop_of(matrix, first), first));
              above_zero += bound > 0;
            });
          }
        }
  EXPECT_GT(above_zero, 1000);
}

TEST(SequenceDag, HasExactCostsToGo) {
  Random random(33);
  const Limits limits;
  for (const CostMatrix& matrix :
       {metric_matrix(7, Variant::kCts, random), turning_matrix(4, Variant::kCts, random),
        turning_matrix(4, Variant::kMg, random)}) {
    const auto dag = SequenceDag::build(matrix, OneTreeRelaxation(matrix), kNever - 1, limits);
    ASSERT_TRUE(dag);
    EXPECT_EQ(dag->outside_bound(), kNever);  // the graph is complete
    for (StopSet left = 0; left < matrix.all(); ++left)
      for_each_port(matrix, matrix.all() & ~left, [&](int at) {
        EXPECT_EQ(dag->cost_to_go(left, at), cheapest_rest(matrix, left, at));
      });
  }
}

// Shifts at the ports account for the cost of turns between two legs, which a spanning tree over
// the least legs does not.
TEST(OneTreeRelaxation, AccountsForMostTurnCosts) {
  Random random(35);
  Time without_turns = 0;
  Time bound = 0;
  Time exact = 0;
  for (int round = 0; round < 20; ++round) {
    const CostMatrix matrix = turning_matrix(8, Variant::kCts, random);
    CostToGo table(matrix);
    ASSERT_TRUE(table.extend(0, Limits()));
    Time best = kNever;
    for_each_port(matrix, matrix.all(), [&](int first) {
      best = std::min(best,
                      add_costs(matrix.from_start(first),
                                table.cost_to_go(matrix.all() & ~stop_of(matrix, first), first)));
    });
    if (best >= kNever) continue;
    without_turns += OneTreeRelaxation(min_matrix(matrix)).root_bound();
    bound += OneTreeRelaxation(matrix).root_bound();
    exact += best;
  }
  EXPECT_LE(bound, exact);
  EXPECT_LT(2 * (exact - bound), exact - without_turns);
}

class OnMaps : public ::testing::Test {
 protected:
  template <class Test>
  void for_maps(int n, unsigned seed, const Test& test) {
    Random random(seed);
    for (const char* map : kMaps)
      for (Variant variant : kVariants) {
        const auto matrix = map_matrix(map, n, variant, random);
        if (!matrix) GTEST_SKIP() << "no Moving AI maps here (set GROVE_MOVINGAI)";
        SCOPED_TRACE(std::string(map) + ", n = " + std::to_string(n));
        test(*matrix);
      }
  }

  Limits limits_;
};

// Returns an upper bound: the cost of a local optimum, found by moving single stops as long as the
// cost decreases.
Time improved_cost(const CostMatrix& matrix, Sequence sequence) {
  Time cost = sequence_cost(matrix, sequence);
  for (bool better = true; better;) {
    better = false;
    for (std::size_t i = 0; i < sequence.size(); ++i)
      for (std::size_t j = 0; j < sequence.size(); ++j) {
        Sequence other = sequence;
        const Stop stop = other[i];
        other.erase(other.begin() + i);
        other.insert(other.begin() + j, stop);
        if (const Time moved = sequence_cost(matrix, other); moved < cost) {
          cost = moved;
          sequence = other;
          better = true;
        }
      }
  }
  return cost;
}

TEST_F(OnMaps, AgreesWithHeldKarp) {
  for (int n : {16, 19})
    for_maps(n, 41, [&](const CostMatrix& matrix) {
      const auto table = make_rtsp_solver(RtspBackend::kHeldKarp, matrix, limits_);
      const auto graph = make_rtsp_solver(RtspBackend::kBoundedDp, matrix, limits_);
      const Time best = table->best({}, kNever).cost;
      ASSERT_EQ(graph->best({}, kNever).cost, best);
      const SequenceClass part{{3, 1, 4}, 0b100};
      const RtspAnswer answer = graph->best(part, best + 4);
      const Time exact = table->best(part, kNever).cost;
      if (answer.kind == RtspAnswer::Kind::kExact)
        ASSERT_EQ(answer.cost, exact);
      else
        ASSERT_TRUE(exact > best + 4 && answer.cost <= exact);
    });
}

// The optimum lies between the lower bound and the heuristic cost. The first 100 sequences of the
// list visit all stops and have the listed costs. A graph with a cost limit higher by 2 has the
// same costs.
TEST_F(OnMaps, SolvesThirtySixStops) {
  for (int n : {24, 30, 36})
    for_maps(n, 42, [&](const CostMatrix& matrix) {
      KBestSequences list(make_rtsp_solver(RtspBackend::kBoundedDp, matrix, limits_), matrix,
                          limits_);
      const Time best = list.resolve(0, kNever);
      ASSERT_TRUE(list.known(0));
      ASSERT_GE(best, relaxation_bound(matrix));
      Sequence any(n);
      std::iota(any.begin(), any.end(), Stop{0});
      for (const Sequence& from : {any, list.sequence(0)})
        ASSERT_LE(best, improved_cost(matrix, from));
      for (std::size_t rank = 0; rank < 100; ++rank) {
        const Time cost = list.resolve(rank, kNever);
        ASSERT_TRUE(is_complete(matrix, list.sequence(rank)));
        ASSERT_EQ(sequence_cost(matrix, list.sequence(rank)), cost);
      }
      const OneTreeRelaxation relaxation(matrix);
      const auto narrow = SequenceDag::build(matrix, relaxation, best, limits_);
      const auto wide = SequenceDag::build(matrix, relaxation, best + 2, limits_);
      ASSERT_EQ(costs_within(*narrow, matrix, best), costs_within(*wide, matrix, best));
      const std::vector<Time> costs = costs_within(*wide, matrix, best + 1);
      for (std::size_t rank = 0; rank < std::min<std::size_t>(costs.size(), 100); ++rank)
        ASSERT_EQ(costs[rank], list.cost_bound(rank));
    });
}

// The optimum is known: stops on a line, numbered in random order, are visited along the line.
TEST(BoundedDp, FindsPlantedOptimumOfSixtyFourStops) {
  constexpr int kStops = 64;
  Random random(43);
  std::vector<Time> at(kStops);
  for (int i = 0; i < kStops; ++i) at[i] = 1 + 3 * i;
  std::shuffle(at.begin(), at.end(), random);
  CostMatrix matrix{CostMatrix::Matrix(kStops + 1)};
  for (int i = 0; i <= kStops; ++i)
    for (int j = 0; j <= kStops; ++j) {
      const Time from = i == kStops ? 0 : at[i];
      const Time to = j == kStops ? 200 : at[j];
      matrix.cost(i, j) = std::abs(from - to);
    }
  const Limits limits;
  KBestSequences list(make_rtsp_solver(RtspBackend::kBoundedDp, matrix, limits), matrix, limits);
  EXPECT_EQ(list.resolve(0, kNever), 200);
  EXPECT_EQ(list.resolve(1, kNever), 206);  // 63 swaps of neighbouring stops
  EXPECT_EQ(list.resolve(63, kNever), 206);
  EXPECT_EQ(list.resolve(64, 206), list.cost_bound(64));
  EXPECT_GT(list.cost_bound(64), 206);
}

}  // namespace bounded_dp_test
}  // namespace grove::detail::testing
