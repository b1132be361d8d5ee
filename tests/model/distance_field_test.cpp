// SPDX-License-Identifier: MIT
#include "model/distance_field.h"

#include <gtest/gtest.h>

#include <string>

namespace grove::detail {
namespace distance_field_test {

TEST(DistanceField, WalksAroundWalls) {
  // . @ .
  // . @ .
  // . . .
  const Grid grid(3, 3, {true, false, true, true, false, true, true, true, true});
  const DistanceField field = distance_field(grid, grid.cell({2, 0}));
  EXPECT_EQ(field[grid.cell({0, 0})], 6);
  EXPECT_EQ(field[grid.cell({2, 0})], 0);
  EXPECT_EQ(field[grid.cell({1, 0})], kNever);
}

TEST(DistanceField, UnreachableIsNever) {
  const Grid grid(3, 1, {true, false, true});
  EXPECT_EQ(distance_field(grid, 0)[2], kNever);
}

TEST(DistanceFields, HoldsTasksAndDestinations) {
  InstanceBuilder builder(Grid(4, 1, std::vector<bool>(4, true)));
  builder.add_agent("a", {0, 0}, Position{3, 0});
  builder.add_task("t", {1, 0}, std::vector<std::string>{"a"});
  const Instance instance = std::move(builder).build();
  const DistanceFields fields(instance);
  EXPECT_EQ(fields.to_rest(0)[0], 3);
  EXPECT_EQ(fields.to_task(0)[3], 2);
}

// A corridor of `cells` cells whose second-last cell is a wall, with one task on the first cell.
Instance corridor(int cells) {
  std::vector<bool> passable(static_cast<std::size_t>(cells), true);
  passable[passable.size() - 2] = false;
  InstanceBuilder builder(Grid(cells, 1, std::move(passable)));
  builder.add_agent("a", {1, 0}, Position{2, 0});
  builder.add_task("t", {0, 0}, std::vector<std::string>{"a"});
  return std::move(builder).build();
}

// 65,534 is the longest distance that is stored in 16 bits.
TEST(DistanceFields, AreExactForLongDistances) {
  for (const int cells : {65'536, 65'537, 65'538, 65'539, 140'000}) {
    const Instance instance = corridor(cells);
    const DistanceFields fields(instance);
    ASSERT_TRUE(fields.complete());
    const DistanceField expected = distance_field(instance.grid(), 0);
    EXPECT_EQ(expected[cells - 3], cells - 3);
    for (Cell cell = 0; cell < cells; ++cell)
      ASSERT_EQ(fields.to_task(0)[cell], expected[cell]) << cell << " of " << cells;
    EXPECT_EQ(fields.to_task(0)[cells - 1], kNever);
  }
}

// An instance with enough tasks for several threads.
Instance many_tasks() {
  constexpr int kSide = 200;
  std::vector<bool> passable(kSide * kSide, true);
  for (std::size_t cell = 0; cell < passable.size(); cell += 7) passable[cell] = false;
  InstanceBuilder builder(Grid(kSide, kSide, passable));
  builder.add_agent("a", {1, 0}, Position{2, 0});
  for (int task = 0; task < 40; ++task)
    builder.add_task("t" + std::to_string(task), Place{1 + 350 * task},
                     std::vector<std::string>{"a"});
  return std::move(builder).build();
}

TEST(DistanceFields, AreTheSameOnManyThreads) {
  const Instance instance = many_tasks();
  const DistanceFields fields(instance, Limits(), 4);
  ASSERT_TRUE(fields.complete());
  for (TaskIndex task = 0; task < instance.task_count(); ++task) {
    const DistanceField expected = distance_field(instance.grid(), instance.task(task).cell);
    for (Cell cell = 0; cell < instance.grid().cell_count(); ++cell)
      ASSERT_EQ(fields.to_task(task)[cell], expected[cell]) << task << ' ' << cell;
  }
}

TEST(DistanceFields, AreIncompleteWhenALimitIsReached) {
  const Instance instance = many_tasks();
  for (const int threads : {1, 4}) {
    Limits stopped;
    stopped.stop(StopReason::kInterrupt);
    EXPECT_FALSE(DistanceFields(instance, stopped, threads).complete());
    Limits without_memory;
    without_memory.set_memory_limit(1);
    EXPECT_FALSE(DistanceFields(instance, without_memory, threads).complete());
    EXPECT_EQ(without_memory.reason(), StopReason::kMemory);
  }
}

}  // namespace distance_field_test
}  // namespace grove::detail
