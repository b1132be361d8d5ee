// SPDX-License-Identifier: MIT
// Splits that are removed because one side is redundant or unused. trim_test.py tests trimming with
// random certificates and grove-verify.
#include "proof/certificate_trim.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace certificate_trim_test {

const std::string kHead = "grove-proof 1\ninstance 0123456789abcdef\nfollowing yes\n";

std::string trimmed(const std::string& proofs) {
  const TemporaryDirectory folder;
  folder.write("c.proof", kHead + proofs + "end\n");
  trim_certificate(folder / "c.proof", folder / "trimmed.proof");
  std::ifstream in(folder / "trimmed.proof", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(text.starts_with(kHead)) << text;
  EXPECT_TRUE(text.ends_with("end\n")) << text;
  return text.substr(kHead.size(), text.size() - kHead.size() - 4);
}

const std::string kOne = "split 0 bar 1 2 2 | 1 bar 1 2 2\n";
const std::string kOther = "split 2 bar 5 3 3 | 3 bar 5 3 3\n";

// After the removed split, exactly the constraints of the enclosing splits are active: a split on
// one of these is removed as well, and a split on a constraint of the removed split stays.
TEST(CertificateTrim, RemovesSplitsWithARedundantFirstSide) {
  EXPECT_EQ(trimmed("theorem 8\n" + kOne + "split 0 bar 1 2 2 | 2 bar 5 3 3\n" + kOne +
                    "leaf\njoint\njoint\n" + kOther + "leaf\njoint\n"),
            "theorem 8\n" + kOne + "leaf\n" + kOther + "leaf\njoint\n");
}

TEST(CertificateTrim, RemovesSplitsWithARedundantSecondSide) {
  EXPECT_EQ(
      trimmed("theorem 8\n" + kOne + "split 2 bar 5 3 3 | 0 bar 1 2 2\njoint\n" + kOther +
              "leaf\njoint\nsplit 3 bar 5 3 3 | 1 bar 1 2 2\njoint\n" + kOther + "leaf\njoint\n"),
      "theorem 8\n" + kOne + kOther + "leaf\njoint\n" + kOther + "leaf\njoint\n");
}

TEST(CertificateTrim, KeepsConstraintsOfARemovedSplitWithTwoRedundantSides) {
  EXPECT_EQ(trimmed("theorem 8\n" + kOne + kOther + "split 0 bar 1 2 2 | 2 bar 5 3 3\n" + kOther +
                    "leaf\njoint\njoint\njoint\nleaf\n"),
            "theorem 8\n" + kOne + kOther + "leaf\njoint\nleaf\n");
  EXPECT_EQ(
      trimmed("theorem 8\n" + kOne + kOther +
              "split 0 bar 4 4 4 | 1 bar 4 4 4\nsplit 0 bar 1 2 2 | 2 bar 5 3 3\nleaf\njoint\n" +
              kOther + "leaf\njoint\njoint\nleaf\n"),
      "theorem 8\n" + kOne + kOther + "split 0 bar 4 4 4 | 1 bar 4 4 4\nleaf\nleaf\njoint\nleaf\n");
}

TEST(CertificateTrim, RemovesSplitsWithAnUnusedSide) {
  const std::string lemma = "lemma 8 0 1\njoint\n";
  const std::string rest = "split 2 norest 4 2 | 2 rest 4 2\n";
  const std::string outer = "split 2 bar 9 1 1 | 3 bar 9 1 1\n";
  for (const std::string& split : {kOne, kOther, rest}) {
    EXPECT_EQ(trimmed(lemma + "theorem 8\n" + outer + split + "leaf 0\njoint\njoint\n"),
              lemma + "theorem 8\nleaf 0\n");
    EXPECT_EQ(
        trimmed(lemma + "theorem 9\n" + outer + split + "joint\nleaf 0\n" + split +
                "leaf 0\njoint\n"),
        lemma + "theorem 9\n" + outer + split + "joint\nleaf 0\n" + split + "leaf 0\njoint\n");
  }
}

}  // namespace certificate_trim_test
}  // namespace grove::detail
