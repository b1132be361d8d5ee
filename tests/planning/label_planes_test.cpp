// SPDX-License-Identifier: MIT
#include "planning/label_planes.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/sanitizers.h"

namespace grove::detail {
namespace label_planes_test {

struct Mark {
  std::uint32_t stamp;
  std::int32_t value;
};

constexpr int kSlots = 1 << 20;
constexpr int kPlanes = 20;
constexpr int kSlotsOnAPage = 512;

std::int64_t page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

// Simulates a search that touches every page of every plane.
void write_all(LabelPlanes<Mark>& planes) {
  for (int plane = 0; plane < kPlanes; ++plane) {
    ASSERT_TRUE(planes.open(plane, Limits()));
    for (int slot = 0; slot < kSlots; slot += kSlotsOnAPage) {
      EXPECT_FALSE(planes.is_current(planes.label(slot, plane)));
      planes.label(slot, plane) = {planes.stamp(), slot + plane};
    }
  }
  for (int plane = 0; plane < kPlanes; ++plane)
    for (int slot = 0; slot < kSlots; slot += kSlotsOnAPage)
      EXPECT_EQ(planes.label(slot, plane).value, slot + plane);
}

TEST(LabelPlanes, HaveNoCurrentLabelsInNewSearch) {
  LabelPlanes<Mark> planes;
  for (int search = 0; search < 4; ++search) {
    planes.begin_search(kSlots);
    write_all(planes);
  }
}

TEST(LabelPlanes, ReleaseWidelyUsedMemoryInNewSearch) {
#ifdef GROVE_SANITIZERS_MEMORY
  GTEST_SKIP() << "the sanitizer's own memory stays";
#endif
  const std::size_t before = resident_bytes();
  constexpr std::size_t kAll = sizeof(Mark) * kSlots * kPlanes;
  LabelPlanes<Mark> planes;
  planes.begin_search(kSlots);
  write_all(planes);
  EXPECT_GT(resident_bytes(), before + kAll / 2);
  planes.begin_search(kSlots);
  EXPECT_LT(resident_bytes(), before + kAll / 2);
}

// Each page faults only once, on its first write. If a read came first, both the read and the write
// would fault.
TEST(LabelPlanes, WriteToPageBeforeReadingIt) {
  constexpr int kPages = kSlots / kSlotsOnAPage;
  LabelPlanes<Mark> planes;
  planes.begin_search(kSlots);
  ASSERT_TRUE(planes.open(0, Limits()));
  const std::int64_t before = page_faults();
  for (int slot = 0; slot < kSlots; slot += kSlotsOnAPage) {
    ASSERT_FALSE(planes.is_current(planes.label(slot, 0)));
    planes.label(slot, 0) = {planes.stamp(), slot};
  }
  EXPECT_LT(page_faults() - before, kPages * 3 / 2);
  planes.begin_search(kSlots);  // keeps the pages, because there are few of them
  ASSERT_TRUE(planes.open(0, Limits()));
  const std::int64_t between = page_faults();
  for (int slot = 0; slot < kSlots; slot += kSlotsOnAPage)
    EXPECT_FALSE(planes.is_current(planes.label(slot, 0)));
  EXPECT_LT(page_faults() - between, kPages / 2);
}

TEST(LabelPlanes, ReportTheMemoryLimitWhenExhausted) {
  Limits limits;
  limits.set_memory_limit(1);
  LabelPlanes<Mark> planes;
  planes.begin_search(kSlots);
  EXPECT_FALSE(planes.open(0, limits));
  EXPECT_TRUE(planes.exhausted());
  EXPECT_EQ(limits.reason(), StopReason::kMemory);
}

}  // namespace label_planes_test
}  // namespace grove::detail
