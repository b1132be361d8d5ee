// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "batch/result_table.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail::batch {
namespace line_file_test {

using Lines = std::vector<std::string_view>;

TEST(LineFiles, AreAppendedTo) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("lines", "a\n");
  {
    LineFile file(path);
    file.append("b\nc\n");
    file.append("");
    file.append("d\n");
    file.flush();
  }
  EXPECT_EQ(file_content(path), "a\nb\nc\nd\n");
  EXPECT_NE(refusal([&] { LineFile file(directory.path()); }).find("cannot be written"),
            std::string::npos);
}

TEST(LineFiles, AreReadWithoutATruncatedLine) {
  EXPECT_EQ(whole_lines(""), Lines());
  EXPECT_EQ(whole_lines("tor"), Lines());
  EXPECT_EQ(whole_lines("a\nb\n"), (Lines{"a", "b"}));
  EXPECT_EQ(whole_lines("a\n\nb\ntor"), (Lines{"a", "", "b"}));
}

}  // namespace line_file_test
}  // namespace grove::detail::batch
