// SPDX-License-Identifier: MIT
#include "search/hash_index.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::detail {
namespace hash_index_test {

// Adds `entries` numbers whose hashes differ in only `bits` bits, and finds each of them.
void add_and_find(int entries, std::uint32_t bits) {
  HashIndex index;
  std::vector<int> values;
  const auto hash_of = [&](int value) {
    return static_cast<std::uint32_t>(value) * 2654435761u | ~((1u << bits) - 1);
  };
  const auto find = [&](int value) {
    return index.find(hash_of(value),
                      [&](HashIndex::Number number) { return values[number] == value; });
  };
  for (int value = 0; value < entries; ++value) {
    EXPECT_EQ(find(value), HashIndex::kNone);
    index.reserve_one();
    values.push_back(value);
    EXPECT_EQ(index.add(hash_of(value)), value);
  }
  EXPECT_EQ(index.size(), entries);
  for (int value = 0; value < entries; ++value) EXPECT_EQ(find(value), value);
  EXPECT_EQ(find(entries), HashIndex::kNone);
}

TEST(HashIndex, FindsEachEntryWhateverItsHash) {
  add_and_find(0, 8);
  add_and_find(1000, 31);
  add_and_find(300, 3);  // most of them share a hash
  add_and_find(50, 0);   // all of them share one hash, that of the last slot of the table
}

TEST(HashIndex, TakesAtMost22BytesPerEntry) {
  HashIndex index;
  EXPECT_EQ(index.bytes(), 0u);
  for (std::uint32_t entry = 0; entry < 10'000; ++entry) {
    index.reserve_one();
    index.add(entry * 2654435761u);
  }
  EXPECT_LE(index.bytes(), 22 * 10'000u);
}

}  // namespace hash_index_test
}  // namespace grove::detail
