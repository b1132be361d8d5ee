// SPDX-License-Identifier: MIT
#include "mpi/batch/gather.h"

#include <gtest/gtest.h>

#include "mpi/simulated_network.h"
#include "simulated_ranks.h"

namespace grove::detail::batch {
namespace gather_test {

// In many rounds, a message from a fast rank must not be counted in the round of a slow rank.
TEST(Gather, ReturnsTheTextsOfAllRanksOnEachRank) {
  for (const int count : {1, 2, 3, 7})
    for (const std::uint64_t seed : {1, 2, 3}) {
      std::mt19937_64 random(seed);
      SimulatedNetwork network(count, [&](int, int, std::size_t) {
        return std::uniform_real_distribution<double>(0, 0.02)(random);
      });
      grove::detail::testing::SimulatedRanks ranks(count, seed);
      ranks.on_time = [&](double now) { network.advance_to(now); };
      const auto text_of = [](int rank, int round) {
        return rank == round % 3 ? "" : std::to_string(round) + " by " + std::to_string(rank);
      };
      int rounds = 0;
      ranks.run([&](int rank) {
        for (int round = 0; round < 20; ++round, ++rounds) {
          const auto all =
              gather(network.at(rank), text_of(rank, round), [&] { ranks.pause(rank); });
          ASSERT_EQ(all.size(), static_cast<std::size_t>(count));
          for (int other = 0; other < count; ++other) EXPECT_EQ(all[other], text_of(other, round));
        }
      });
      EXPECT_EQ(rounds, 20 * count);
    }
}

}  // namespace gather_test
}  // namespace grove::detail::batch
