// SPDX-License-Identifier: MIT
#include "io/csv.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace csv_test {

TEST(Csv, QuotesCellsWithSpecialCharacters) {
  EXPECT_EQ(csv_cell(""), "");
  EXPECT_EQ(csv_cell("a b;c"), "a b;c");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"a\""), "\"say \"\"a\"\"\"");
  EXPECT_EQ(csv_cell("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_cell("a\rb"), "\"a\rb\"");
}

TEST(Csv, FormulaGetsAnApostrophe) {
  EXPECT_EQ(csv_cell("=1+2"), "'=1+2");
  EXPECT_EQ(csv_cell("=cmd|' /C calc'!A0"), "'=cmd|' /C calc'!A0");
  EXPECT_EQ(csv_cell("@SUM(A1)"), "'@SUM(A1)");
  EXPECT_EQ(csv_cell("+1-2"), "'+1-2");
  EXPECT_EQ(csv_cell("-2+3"), "'-2+3");
  EXPECT_EQ(csv_cell("\t=1"), "'\t=1");
  EXPECT_EQ(csv_cell("\r=1"), "\"'\r=1\"");
  EXPECT_EQ(csv_cell("=a,b"), "\"'=a,b\"");
}

TEST(Csv, NumberIsNoFormula) {
  for (const char* number : {"-1", "-1.5e-3", "-0"}) EXPECT_EQ(csv_cell(number), number);
  EXPECT_EQ(csv_cell("-inf"), "'-inf");
}

// A spreadsheet removes one apostrophe, so a value that starts with an apostrophe gets a second
// one.
TEST(Csv, ApostropheBeforeAFormulaIsDoubled) {
  EXPECT_EQ(csv_cell("'=1"), "''=1");
  EXPECT_EQ(csv_cell("''=1"), "'''=1");
  EXPECT_EQ(csv_cell("'a"), "'a");
  EXPECT_EQ(csv_cell("'"), "'");
}

}  // namespace csv_test
}  // namespace grove::detail
