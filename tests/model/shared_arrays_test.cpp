// SPDX-License-Identifier: MIT
// Tests SharedArrays with several members. Here the members are threads, each with its own
// SharedArrays object on the same memory.
#include "model/shared_arrays.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "model/distance_field.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace shared_arrays_test {

using testing::ClockReadingLimit;

// The shared memory of one host. Only the bytes that must initially be zero are zero.
class Memory {
 public:
  explicit Memory(const ArrayLayout& layout)
      : layout_(layout),
        bytes_(SharedArrays::bytes(layout)),
        begin_(new (kAligned) std::byte[bytes_]) {
    std::memset(begin_.get(), 0xA5, bytes_);
    std::memset(begin_.get(), 0, SharedArrays::zero_bytes(layout));
  }
  SharedArrays of(int member, int members) const {
    return {{begin_.get(), bytes_}, layout_, member, members};
  }
  bool holds(const std::byte* place) const {
    return begin_.get() <= place && place < begin_.get() + bytes_;
  }

 private:
  static constexpr std::align_val_t kAligned{SharedArrays::kAlignment};
  struct Delete {
    void operator()(std::byte* begin) const { ::operator delete[](begin, kAligned); }
  };
  ArrayLayout layout_;
  std::size_t bytes_;
  std::unique_ptr<std::byte[], Delete> begin_;
};

// Calls work(member) in parallel, with one thread per member.
template <class Work>
void by_members(int members, const Work& work) {
  std::vector<std::jthread> threads;
  for (int member = 0; member < members; ++member)
    threads.emplace_back([&work, member] { work(member); });
}

constexpr std::size_t kArrayBytes = 5000;

ArrayLayout layout_of(std::size_t arrays) {
  return {std::vector(arrays, kArrayBytes), {}, std::vector(arrays, kArrayBytes)};
}

// Fills the array slowly, so that a member that reads it too early sees other bytes.
void fill(std::byte* begin, std::size_t number) {
  for (std::size_t i = 0; i < kArrayBytes; ++i) {
    begin[i] = static_cast<std::byte>(number * 31 + i);
    if (i % 1000 == 0) std::this_thread::yield();
  }
}

bool is_filled(const std::byte* begin, std::size_t number) {
  for (std::size_t i = 0; i < kArrayBytes; ++i)
    if (begin[i] != static_cast<std::byte>(number * 31 + i)) return false;
  return true;
}

TEST(SharedArrays, OneMemberMakesEachArrayAndAllReadIt) {
  constexpr std::size_t kArrays = 300;
  constexpr int kMembers = 4;
  const Memory memory(layout_of(kArrays));
  std::vector<std::atomic<int>> made(kArrays);
  std::atomic<int> wrong{0};
  by_members(kMembers, [&](int member) {
    const SharedArrays arrays = memory.of(member, kMembers);
    for (std::size_t number = 0; number < kArrays; ++number) {
      const auto* begin =
          arrays.array(ArrayKind::kDistances, number).get(Limits(), [&](std::byte* to) {
            ++made[number];
            fill(to, number);
            return true;
          });
      if (!begin || !memory.holds(begin) || !is_filled(begin, number)) ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
  for (const std::atomic<int>& times : made) EXPECT_EQ(times, 1);
}

TEST(SharedArrays, MembersBeginAtDifferentArrays) {
  const Memory memory(layout_of(1));
  EXPECT_EQ(memory.of(0, 4).first_of(10), 0U);
  EXPECT_EQ(memory.of(1, 4).first_of(10), 2U);
  EXPECT_EQ(memory.of(3, 4).first_of(10), 7U);
}

TEST(SharedArrays, RefuseMisalignedMemory) {
  alignas(SharedArrays::kAlignment) std::array<std::byte, 2 * SharedArrays::kAlignment> bytes{};
  const std::span<std::byte> memory(bytes);
  EXPECT_NO_THROW(SharedArrays(memory, {}, 0, 1));
  EXPECT_THROW(SharedArrays(memory.subspan(8), {}, 0, 1), std::invalid_argument);
}

TEST(SharedArrays, MissingArrayIsNullptr) {
  const Memory memory({std::vector<std::size_t>{kArrayBytes, 0, kArrayBytes}, {}, {}});
  const SharedArrays arrays = memory.of(0, 1);
  const auto never = [](std::byte*) -> bool { throw std::logic_error("there is nothing to fill"); };
  for (const SharedArray none :
       {arrays.array(ArrayKind::kDistances, 1), arrays.array(ArrayKind::kDistances, 3),
        arrays.array(ArrayKind::kStopsOfStates, 0), SharedArray()}) {
    EXPECT_FALSE(none.has_room(1));
    EXPECT_EQ(none.get(Limits(), never), nullptr);
  }
  EXPECT_TRUE(arrays.array(ArrayKind::kDistances, 2).has_room(kArrayBytes));
  EXPECT_FALSE(arrays.array(ArrayKind::kDistances, 2).has_room(kArrayBytes + 1));
}

TEST(SharedArrays, FailedArrayIsNullptrForAllMembers) {
  const Memory memory(layout_of(2));
  const SharedArrays one = memory.of(0, 2);
  const SharedArrays other = memory.of(1, 2);
  EXPECT_EQ(one.array(ArrayKind::kDistances, 0).get(Limits(), [](std::byte*) { return false; }),
            nullptr);
  EXPECT_THROW(
      one.array(ArrayKind::kDistances, 1).make([](std::byte*) -> bool { throw std::bad_alloc(); }),
      std::bad_alloc);
  for (const std::size_t number : {0, 1}) {
    const ClockReadingLimit limits(testing::kUnlimitedReadings);
    EXPECT_EQ(other.array(ArrayKind::kDistances, number)
                  .get(limits,
                       [](std::byte*) {
                         ADD_FAILURE() << "a failed array is made only once";
                         return true;
                       }),
              nullptr);
    EXPECT_EQ(limits.readings(), 0) << "the failure is known at once";
  }
}

TEST(SharedArrays, AwaitEndsWhenTheMakerIsUnresponsive) {
  const Memory memory(layout_of(1));
  std::atomic<bool> begun{false};
  std::atomic<bool> may_end{false};
  by_members(2, [&](int member) {
    const SharedArray array = memory.of(member, 2).array(ArrayKind::kDistances, 0);
    if (member == 0)
      return array.make([&](std::byte* begin) {
        begun = true;
        while (!may_end) std::this_thread::yield();
        fill(begin, 0);
        return true;
      });
    while (!begun) std::this_thread::yield();
    const ClockReadingLimit limits(20'000);
    EXPECT_EQ(array.await(limits), nullptr);
    EXPECT_FALSE(limits.stop_requested());
    EXPECT_GT(limits.readings(), 100) << "waits for some time";
    const ClockReadingLimit stopped(testing::kUnlimitedReadings);
    stopped.stop(StopReason::kInterrupt);
    EXPECT_EQ(array.await(stopped), nullptr);
    EXPECT_LE(stopped.readings(), 2);
    may_end = true;
  });
  const auto* begin = memory.of(1, 2).array(ArrayKind::kDistances, 0).await(Limits());
  ASSERT_NE(begin, nullptr);  // the array becomes available
  EXPECT_TRUE(is_filled(begin, 0));
}

// Returns an instance on two rows of `width` cells with many tasks. With 66,000 cells per row,
// distances do not fit in 16 bits.
Instance many_tasks(int width, int tasks) {
  InstanceBuilder builder(
      Grid(width, 2, std::vector<bool>(static_cast<std::size_t>(width) * 2, true)));
  builder.add_agent("a", {1, 0}, Position{2, 0});
  for (int task = 0; task < tasks; ++task)
    builder.add_task("t" + std::to_string(task), Place{3 + 7 * task},
                     std::vector<std::string>{"a"});
  return std::move(builder).build();
}

TEST(SharedDistances, EqualDistancesWithoutSharing) {
  for (const int width : {3000, 66'000}) {
    const Instance instance = many_tasks(width, 30);
    const DistanceFields alone(instance);
    const Memory memory({DistanceFields::layout_of(instance), {}, {}});
    std::atomic<int> wrong{0};
    by_members(3, [&](int member) {
      const SharedArrays arrays = memory.of(member, 3);
      const DistanceFields shared(instance, Limits(), 2, nullptr, &arrays);
      if (!shared.complete()) ++wrong;
      for (TaskIndex task = 0; task < instance.task_count(); ++task)
        for (State state = 0; state < instance.world().state_count(); ++state)
          if (shared.to_task(task)[state] != alone.to_task(task)[state]) ++wrong;
      for (State state = 0; state < instance.world().state_count(); ++state)
        if (shared.to_rest(0)[state] != alone.to_rest(0)[state]) ++wrong;
    });
    EXPECT_EQ(wrong, 0) << width;
    // The fields are in the shared memory if they fit in 16 bits.
    const SharedArrays arrays = memory.of(0, 3);
    for (std::size_t set = 0; set < DistanceFields::layout_of(instance).size(); ++set)
      EXPECT_EQ(arrays.array(ArrayKind::kDistances, set).await(Limits()) != nullptr, width == 3000);
  }
}

TEST(SharedDistances, AreCompleteAlthoughAMemberHasStopped) {
  const Instance instance = many_tasks(3000, 20);
  const Memory memory({DistanceFields::layout_of(instance), {}, {}});
  const SharedArrays of_stopped = memory.of(0, 2);
  Limits stopped;
  stopped.stop(StopReason::kTime);
  EXPECT_FALSE(DistanceFields(instance, stopped, 1, nullptr, &of_stopped).complete());
  const SharedArrays arrays = memory.of(1, 2);
  const DistanceFields shared(instance, Limits(), 1, nullptr, &arrays);
  ASSERT_TRUE(shared.complete());
  EXPECT_EQ(shared.to_task(5)[0], distance_field(instance.grid(), instance.task(5).cell)[0]);
}

}  // namespace shared_arrays_test
}  // namespace grove::detail
