// SPDX-License-Identifier: MIT
#include "tools/solve/disk_flusher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace disk_flusher_test {

std::string stderr_of_flushing(const std::vector<std::string>& files) {
  ::testing::internal::CaptureStderr();
  {
    DiskFlusher flusher;
    for (const std::string& file : files) flusher.flush(file);
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(DiskFlusher, PrintsNothingIfAllFilesExist) {
  const TemporaryDirectory directory;
  std::vector<std::string> files;
  for (int i = 0; i < 20; ++i) files.push_back(directory.write(std::to_string(i), "plan"));
  EXPECT_EQ(stderr_of_flushing({}), "");
  EXPECT_EQ(stderr_of_flushing(files), "");
}

// The message proves that the flusher tried to flush and that its destructor waited for this.
TEST(DiskFlusher, ReportsTheFirstFailureOnce) {
  const TemporaryDirectory directory;
  const std::string output = stderr_of_flushing({directory / "a", directory / "b"});
  EXPECT_NE(output.find("/a: cannot be written: No such file"), std::string::npos) << output;
  EXPECT_EQ(std::ranges::count(output, '\n'), 1);
}

}  // namespace disk_flusher_test
}  // namespace grove::detail
