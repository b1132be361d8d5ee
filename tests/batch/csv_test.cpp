// SPDX-License-Identifier: MIT
#include "src/batch/csv.h"

#include <gtest/gtest.h>

namespace grove::detail::batch {
namespace csv_test {

TEST(CsvCells, AreQuotedOnlyWhereTheyMust) {
  EXPECT_EQ(csv_quoted(""), "");
  EXPECT_EQ(csv_quoted("a b;c"), "a b;c");
  EXPECT_EQ(csv_quoted("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_quoted("say \"a\""), "\"say \"\"a\"\"\"");
  EXPECT_EQ(csv_quoted("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_quoted("a\rb"), "\"a\rb\"");
}

}  // namespace csv_test
}  // namespace grove::detail::batch
