// SPDX-License-Identifier: MIT
#include "planning/bucket_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace grove::detail {
namespace bucket_queue_test {

BucketQueue::Entry entry(std::int32_t slot, std::uint16_t conflicts) {
  return {.slot = slot, .conflicts = conflicts};
}

std::vector<std::int32_t> drain(BucketQueue& queue) {
  std::vector<std::int32_t> slots;
  for (BucketQueue::Entry e; queue.pop(e);) slots.push_back(e.slot);
  return slots;
}

TEST(BucketQueue, OrdersByLayerThenConflictsThenLastIn) {
  BucketQueue queue;
  queue.reset(10);
  queue.push(12, entry(5, 0));
  queue.push(10, entry(3, 2));
  queue.push(10, entry(2, 1));
  queue.push(10, entry(1, 1));
  queue.push(5000, entry(7, 0));
  queue.push(4000, entry(6, 9));
  EXPECT_EQ(drain(queue), (std::vector<std::int32_t>{1, 2, 3, 5, 6, 7}));
}

TEST(BucketQueue, ResetRemovesAllEntries) {
  BucketQueue queue;
  queue.reset(0);
  for (Time layer : {0, 1, 900, 5000}) queue.push(layer, entry(1, 1023));
  queue.reset(7);
  EXPECT_EQ(queue.layer(), 7);
  EXPECT_TRUE(drain(queue).empty());
}

// Compares random pushes and pops with those of a multimap.
TEST(BucketQueue, AgreesWithSortedMap) {
  std::mt19937 random(1);
  BucketQueue queue;
  for (int round = 0; round < 100; ++round) {
    queue.reset(round);
    std::multimap<std::pair<Time, int>, std::int32_t> expected;
    for (int step = 0; step < 300; ++step) {
      if (random() % 2 == 0) {
        const Time layer = queue.layer() + static_cast<Time>(random() % (step % 7 == 0 ? 3000 : 3));
        const auto conflicts = static_cast<std::uint16_t>(random() % 4);
        queue.push(layer, entry(step, conflicts));
        expected.emplace(std::pair(layer, conflicts), step);
        continue;
      }
      BucketQueue::Entry e;
      ASSERT_EQ(queue.pop(e), !expected.empty());
      if (expected.empty()) continue;
      const auto first = expected.begin()->first;
      ASSERT_EQ(std::pair(queue.layer(), int{e.conflicts}), first);
      const auto [begin, end] = expected.equal_range(first);
      const auto found = std::find_if(begin, end, [&](auto& x) { return x.second == e.slot; });
      ASSERT_NE(found, end);
      expected.erase(found);
    }
  }
}

}  // namespace bucket_queue_test
}  // namespace grove::detail
