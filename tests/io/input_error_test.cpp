// SPDX-License-Identifier: MIT
#include "io/input_error.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace input_error_test {

TEST(InputError, NamesFilePlaceAndMessage) {
  EXPECT_STREQ(InputError("a.map", "line 2, column 1", "wrong").what(),
               "a.map: line 2, column 1: wrong");
  EXPECT_STREQ(InputError("a.map", "", "wrong").what(), "a.map: wrong");
}

TEST(OneLine, EscapesControlCharacters) {
  EXPECT_EQ(one_line("a\nb\tc\x1b[31m\x7f"), "a\\nb\\tc\\x1b[31m\\x7f");
  EXPECT_EQ(one_line(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(OneLine, KeepsUtf8AndEscapesOtherBytes) {
  EXPECT_EQ(one_line("Rübe 樹 🌳"), "Rübe 樹 🌳");
  EXPECT_EQ(one_line("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(one_line("\xc0\xaf"), "\\xc0\\xaf");  // overlong encoding
  EXPECT_EQ(one_line("\xe6\xa8x"), "\\xe6\\xa8x");
}

TEST(OneLine, TruncatesLongTexts) {
  EXPECT_LT(one_line(std::string(1 << 20, 'x')).size(), 500U);
}

}  // namespace input_error_test
}  // namespace grove::detail
