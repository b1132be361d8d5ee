// SPDX-License-Identifier: MIT
#include "mpi/simulated_network.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace simulated_network_test {

TEST(SimulatedNetwork, DeliversAfterTheDelay) {
  SimulatedNetwork network(2, [](int, int, std::size_t bytes) { return double(bytes); });
  network.at(0).send(1, "abc");
  EXPECT_EQ(network.next_arrival(1), 3);
  EXPECT_FALSE(network.at(1).receive());
  network.advance_to(3);
  const auto parcel = network.at(1).receive();
  ASSERT_TRUE(parcel);
  EXPECT_EQ(parcel->from, 0);
  EXPECT_EQ(parcel->bytes, "abc");
  EXPECT_FALSE(network.at(1).receive());
  EXPECT_EQ(network.at(0).messages(), 1);
  EXPECT_EQ(network.at(0).bytes(), 3);
}

TEST(SimulatedNetwork, KeepsOrderOnlyWithinEachPair) {
  std::vector<double> delays{9, 1, 2};
  std::size_t next = 0;
  SimulatedNetwork network(3, [&](int, int, std::size_t) { return delays[next++]; });
  network.at(0).send(2, "slow");
  network.at(0).send(2, "waits for it");
  network.at(1).send(2, "overtakes");
  network.advance_to(10);
  EXPECT_EQ(network.at(2).receive()->bytes, "overtakes");
  EXPECT_EQ(network.at(2).receive()->bytes, "slow");
  EXPECT_EQ(network.at(2).receive()->bytes, "waits for it");
}

}  // namespace simulated_network_test
}  // namespace grove::detail
