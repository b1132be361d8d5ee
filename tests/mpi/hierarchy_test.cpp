// SPDX-License-Identifier: MIT
#include "mpi/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace grove::detail {
namespace hierarchy_test {

TEST(Hierarchy, HasMinimalLevelsAndChildren) {
  const auto shape = [](int ranks, int most) {
    const Hierarchy hierarchy(ranks, most);
    int children = 0;
    for (int rank = 0; rank < ranks; ++rank)
      for (int level = 1; level <= hierarchy.highest_at(rank); ++level)
        children = std::max(children, hierarchy.children({rank, level}));
    return std::pair(hierarchy.levels(), children);
  };
  EXPECT_EQ(shape(1, 64), std::pair(1, 1));
  EXPECT_EQ(shape(64, 64), std::pair(1, 64));
  EXPECT_EQ(shape(65, 64), std::pair(2, 9));
  EXPECT_EQ(shape(4096, 64), std::pair(2, 64));
  EXPECT_EQ(shape(4097, 64), std::pair(3, 17));
  EXPECT_EQ(shape(8, 2), std::pair(3, 2));
}

// Each endpoint except the top has exactly one parent, and occurs exactly once among the parent's
// children.
TEST(Hierarchy, EveryEndpointHasOneParent) {
  for (const int ranks : {1, 2, 3, 7, 8, 9, 26, 64, 100, 1000})
    for (const int most : {2, 3, 5, 64}) {
      const Hierarchy hierarchy(ranks, most);
      EXPECT_EQ(hierarchy.highest_at(0), hierarchy.levels());
      std::int64_t below = 0;
      for (int rank = 0; rank < ranks; ++rank)
        for (int level = 0; level <= hierarchy.highest_at(rank); ++level) {
          const Endpoint post{rank, level};
          if (level > 0) {
            ASSERT_LE(hierarchy.children(post), most);
            below += hierarchy.children(post);
          }
          if (post == hierarchy.top()) continue;
          const Endpoint parent = hierarchy.parent(post);
          ASSERT_LE(parent.level, hierarchy.highest_at(parent.rank));
          ASSERT_TRUE(hierarchy.is_below(parent, rank));
          const int number = hierarchy.child_with(parent, rank);
          ASSERT_LT(number, hierarchy.children(parent));
          ASSERT_EQ(hierarchy.child(parent, number), post);
        }
      int posts = 0;
      for (int rank = 0; rank < ranks; ++rank) posts += 1 + hierarchy.highest_at(rank);
      EXPECT_EQ(below, posts - 1) << ranks << " ranks, at most " << most;
    }
}

}  // namespace hierarchy_test
}  // namespace grove::detail
