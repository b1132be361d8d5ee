// SPDX-License-Identifier: MIT
#include "tools/bench/bench_instances.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_directory.h"

namespace grove::detail::bench {
namespace bench_instances_test {

class Orders : public ::testing::Test {
 protected:
  batch::Entry entry(const std::string& id) {
    directory_.write("a.map", "type octile\nheight 1\nwidth 2\nmap\n..\n");
    return {.id = id,
            .path = directory_.write(
                id + ".cts.json",
                R"({"map": "a.map", "agents": [{"id": "a", "start": [0, 0], "goal": [1, 0]}],
                    "tasks": []})")};
  }

  TemporaryDirectory directory_;
};

TEST_F(Orders, AreBalanced) {
  std::vector<std::string> ids;
  for (const BenchInstance& instance :
       balanced({entry("b_s2_n5"), entry("b_s10_n5"), entry("b_s1_n5"), entry("a_s1_n5"),
                 entry("a_s2_n5"), entry("other")}))
    ids.push_back(instance.entry.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"other", "b_s1_n5", "a_s1_n5", "b_s2_n5", "a_s2_n5",
                                           "b_s10_n5"}));
}

TEST_F(Orders, IncludeABrokenInstanceWithItsError) {
  const auto instances =
      balanced({entry("good"), {.id = "x", .path = directory_.write("x.cts.json", "{")}});
  ASSERT_EQ(instances.size(), 2U);
  EXPECT_EQ(instances[0].error, "");
  EXPECT_NE(instances[1].error.find("x.cts.json"), std::string::npos);
}

}  // namespace bench_instances_test
}  // namespace grove::detail::bench
