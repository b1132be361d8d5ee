// SPDX-License-Identifier: MIT
// Compares prices to go and completion bounds with dynamic programming over all sets of stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "sequencing/cost_to_go.h"
#include "sequencing/optional_stops_dag.h"
#include "tests/sequencing/matrices.h"

namespace grove::detail {
namespace optional_stops_test {

using testing::Random;
using testing::Variant;

// The price to go of every state, and the least price of a sequence through a state.
class Reference {
 public:
  Reference(const CostMatrix& matrix, const std::vector<Time>& skip)
      : matrix_(matrix), skip_(skip), stops_(matrix.stops()) {
    const StopSet sets = StopSet{1} << stops_;
    to_go_.assign(sets * static_cast<std::size_t>(stops_), kNever);
    before_ = to_go_;
    for (StopSet left = 0; left < sets; ++left)
      for (int at = 0; at < stops_; ++at)
        if ((left & bit(at)) == 0) to_go_[index(left, at)] = price_to_go(left, at);
    for (StopSet left = sets; left-- > 0;)
      for (int at = 0; at < stops_; ++at)
        if ((left & bit(at)) == 0) before_[index(left, at)] = cost_before(left, at);
  }

  Time to_go(StopSet left, int at) const { return to_go_[index(left, at)]; }
  Time through(StopSet left, int at) const {
    return add_costs(before_[index(left, at)], to_go(left, at));
  }

 private:
  std::size_t index(StopSet left, int at) const {
    return left * static_cast<std::size_t>(stops_) + static_cast<std::size_t>(at);
  }
  Time price_to_go(StopSet left, int at) const {
    Time best = add_costs(matrix_.to_end(at), price_without(skip_, left));
    for_each_stop(left, [&](int next) {
      best = std::min(best, add_costs(matrix_.between(at, next), to_go(left & ~bit(next), next)));
    });
    return best;
  }
  Time cost_before(StopSet left, int at) const {
    const StopSet visited = all_stops(stops_) & ~left & ~bit(at);
    if (visited == 0) return matrix_.from_start(at);
    Time best = kNever;
    for_each_stop(visited, [&](int last) {
      best = std::min(best,
                      add_costs(before_[index(left | bit(at), last)], matrix_.between(last, at)));
    });
    return best;
  }

  const CostMatrix& matrix_;
  const std::vector<Time>& skip_;
  const int stops_;
  std::vector<Time> to_go_;
  std::vector<Time> before_;  // least cost up to the state
};

std::vector<Time> random_prices(int stops, Random& random) {
  std::vector<Time> skip;
  for (int stop = 0; stop < stops; ++stop)
    skip.push_back(random() % 4 == 0 ? kNever : static_cast<Time>(random() % 12));
  return skip;
}

TEST(OptionalStops, AgreeWithDynamicProgramming) {
  Random random(5);
  int known = 0;
  int outside = 0;
  for (int round = 0; round < 400; ++round) {
    const int stops = 1 + static_cast<int>(random() % 7);
    const Variant variant = round % 2 == 0 ? Variant::kCts : Variant::kMg;
    const CostMatrix matrix = round % 3 == 0   ? testing::wild_matrix(stops, variant, random)
                              : round % 3 == 1 ? testing::grid_matrix(stops, variant, random)
                                               : testing::metric_matrix(stops, variant, random);
    const std::vector<Time> skip = random_prices(stops, random);
    const Reference reference(matrix, skip);
    CostToGo prices = CostToGo::with_prices(matrix, skip);
    const auto limit = static_cast<Time>(random() % 60);
    if (!prices.extend(limit, Limits())) continue;  // walks have no least price
    EXPECT_GT(prices.outside_bound(), limit);
    for (StopSet left = 0; left <= all_stops(stops); ++left)
      for (int at = 0; at < stops; ++at) {
        if ((left & bit(at)) != 0) continue;
        const Time price = prices.cost_to_go(left, at);
        EXPECT_GE(price, reference.to_go(left, at));
        if (reference.through(left, at) < prices.outside_bound()) {
          EXPECT_EQ(price, reference.to_go(left, at));
          ++known;
        } else {
          ++outside;
        }
      }
  }
  EXPECT_GT(known, 1000);
  EXPECT_GT(outside, 1000);
}

TEST(OptionalStops, CompletionBoundsAreValid) {
  Random random(6);
  int tight = 0;
  int bounds = 0;
  for (int round = 0; round < 400; ++round) {
    const int stops = 1 + static_cast<int>(random() % 9);
    const CostMatrix matrix = round % 2 == 0 ? testing::grid_matrix(stops, Variant::kCts, random)
                                             : testing::metric_matrix(stops, Variant::kMg, random);
    const std::vector<Time> skip = random_prices(stops, random);
    const Reference reference(matrix, skip);
    const auto completions = CompletionBounds::make(matrix, skip, {}, Limits());
    if (!completions) continue;
    for (StopSet left = 0; left <= all_stops(stops); ++left)
      for (int at = 0; at < stops; ++at) {
        if ((left & bit(at)) != 0) continue;
        EXPECT_LE(completions->from(at, left), reference.to_go(left, at));
        ++bounds;
        tight += completions->from(at, left) == reference.to_go(left, at) ? 1 : 0;
      }
  }
  EXPECT_GT(2 * tight, bounds);
}

}  // namespace optional_stops_test
}  // namespace grove::detail
