// SPDX-License-Identifier: MIT
#include "model/thread_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace grove::detail {
namespace thread_team_test {

TEST(ThreadTeam, CallsWorkOnceOnEachThreadInEveryRound) {
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    ASSERT_EQ(team.size(), threads);
    std::vector<int> calls(static_cast<std::size_t>(threads));
    std::vector<std::thread::id> ids(calls.size());
    for (int round = 1; round <= 200; ++round) {
      team.run([&](int thread) {
        ++calls[static_cast<std::size_t>(thread)];
        ids[static_cast<std::size_t>(thread)] = std::this_thread::get_id();
      });
      EXPECT_EQ(calls, std::vector<int>(calls.size(), round));
    }
    EXPECT_EQ(ids.front(), std::this_thread::get_id());
    EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), ids.size());
  }
}

// Terminates only if all threads execute the work concurrently.
TEST(ThreadTeam, RunsItsThreadsConcurrently) {
  ThreadTeam team(4);
  std::barrier barrier(4);
  team.run([&](int) { barrier.arrive_and_wait(); });
}

TEST(ThreadTeam, RethrowsAfterAllThreadsHaveEnded) {
  ThreadTeam team(3);
  for (int thrower = 0; thrower < 3; ++thrower) {
    std::atomic<int> ended{0};
    EXPECT_THROW(team.run([&](int thread) {
      if (thread == thrower) throw std::runtime_error("no");
      ++ended;
    }),
                 std::runtime_error);
    EXPECT_EQ(ended, 2);
    EXPECT_NO_THROW(team.run([](int) {}));
  }
}

}  // namespace thread_team_test
}  // namespace grove::detail
