// SPDX-License-Identifier: MIT
// Tests that the strict readers accept original Moving AI benchmark files without a warning.
#include "tests/support/movingai.h"

#include <gtest/gtest.h>

#include "io/instance_file.h"
#include "io/scenario_file.h"

namespace grove::detail {
namespace movingai_test {

TEST(MovingAi, FilesAreReadWithoutAWarning) {
  if (!has_movingai()) GTEST_SKIP() << movingai_missing();
  const auto directory = movingai_directory();
  for (const char* name : {"empty-32-32", "random-32-32-20", "room-32-32-4", "den312d"}) {
    const auto map = directory / (std::string(name) + ".map");
    const auto scenario = directory / (std::string(name) + "-random-1.scen");
    const int rows = static_cast<int>(read_scenario(scenario).size());
    const LoadedInstance loaded = read_scenario_instance(scenario, map, rows);
    EXPECT_EQ(loaded.instance.agent_count(), rows);
    EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
  }
}

}  // namespace movingai_test
}  // namespace grove::detail
