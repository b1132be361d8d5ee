// SPDX-License-Identifier: MIT
#include "proof/certificate_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <string>
#include <string_view>
#include <vector>

#include "io/input_error.h"
#include "proof/certificate.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace certificate_text_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;

// Three agents, two with goals and one without, and a task, on a 2 x 2 grid.
Instance three_agents() {
  InstanceBuilder builder{Map(Grid(2, 2, std::vector<bool>(4, true)))};
  builder.add_agent("a", Position{0, 0}, Position{1, 0});
  builder.add_agent("b", Position{1, 0}, Position{0, 0});
  builder.add_agent("c", Position{1, 1}, std::nullopt);
  builder.add_task("t", Position{1, 1}, std::vector<std::string>{"a"});
  return std::move(builder).build();
}

class CertificateTexts : public ::testing::Test {
 protected:
  std::string head(std::string_view following = "yes") const {
    return fmt::format("grove-proof 1\ninstance {:016x}\nfollowing {}\n",
                       certificate_checksum(instance_), following);
  }
  CertificateText read(const std::string& bytes, std::int64_t max_splits = 100) const {
    folder_.write("c.proof", bytes);
    return read_certificate(folder_ / "c.proof", instance_, max_splits);
  }
  // Returns the message of the refusal, without the file name.
  std::string refusal(const std::string& bytes, std::int64_t max_splits = 100) const {
    try {
      read(bytes, max_splits);
    } catch (const InputError& error) {
      const std::string text = error.what();
      const std::string name = "c.proof: ";
      return text.substr(text.find(name) + name.size());
    }
    return "it was read";
  }
  // Like refusal(), for a certificate whose theorem has this proof, which starts in line 5.
  std::string refusal_of_proof(const std::string& proof) const {
    return refusal(head() + "theorem 4\n" + proof + "end\n");
  }

  const TemporaryDirectory folder_;
  const Instance instance_ = three_agents();
};

// Contains every construct of the grammar.
constexpr std::string_view kAll =
    "lemma inf 0 1\ndemand 1 bar 2 0 inf\njoint\n"
    "lemma 3 1\nleaf\n"
    "theorem 4\n"
    "split 0 bar 1 1 1 | 1 move 1 0 1 2\n"
    "split 0 norest 1 5 | 0 rest 1 5\n"
    "leaf 0 1\n"
    "split 0 stop 0 0 | 0 nostop 0 0\nleaf\nleaf 1\n"
    "later 0 4 1 5 0\njoint\n"
    "split 0 pass 2 0 1 3 | 1 pass 3 1 0 inf\nleaf\n"
    "prices\nplace 0 1 20\nedge 0 1 3 5\nfinish 0 4 1 5 7\nend\n"
    "end\n";

TEST_F(CertificateTexts, AreReadPlainOrCompressed) {
  const std::string text = head() + std::string(kAll);
  const CertificateText plain = read(text, 5);
  EXPECT_EQ(plain.lines, text);
  EXPECT_EQ(plain.bound, 4);
  EXPECT_TRUE(plain.may_follow);
  std::string compressed(ZSTD_compressBound(text.size()), '\0');
  compressed.resize(
      ZSTD_compress(compressed.data(), compressed.size(), text.data(), text.size(), 3));
  EXPECT_EQ(read(compressed).lines, text);
  const CertificateText none = read(head("no") + "theorem inf\njoint\nend\n");
  EXPECT_EQ(none.bound, kInfiniteCost);
  EXPECT_FALSE(none.may_follow);
}

TEST_F(CertificateTexts, AreRefusedWithTheLineIfTruncated) {
  const std::string text = head() + std::string(kAll);
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_THAT(refusal(text.substr(0, size)), HasSubstr("; expected")) << size;
  EXPECT_EQ(refusal(""), "line 1: the file ends; expected a line, ended by LF");
  EXPECT_EQ(refusal(head() + "theorem 4"),
            "line 4: the file ends within it; expected a line, ended by LF");
  std::string compressed(ZSTD_compressBound(text.size()), '\0');
  compressed.resize(
      ZSTD_compress(compressed.data(), compressed.size(), text.data(), text.size(), 3));
  for (std::size_t size = 4; size < compressed.size(); ++size)
    EXPECT_THAT(refusal(compressed.substr(0, size)), HasSubstr("; expected")) << size;
  compressed[8] = static_cast<char>(compressed[8] ^ 0x5A);
  EXPECT_THAT(refusal(compressed), HasSubstr("; expected"));
}

TEST_F(CertificateTexts, AreRefusedIfOfAnotherInstance) {
  EXPECT_EQ(
      refusal("grove-proof 1\ninstance 0123456789abcdef\nfollowing yes\ntheorem 4\nleaf\nend\n"),
      fmt::format("line 2: found '0123456789abcdef'; expected {:016x}, the checksum of this "
                  "instance",
                  certificate_checksum(instance_)));
}

TEST_F(CertificateTexts, FollowTheGrammarExactly) {
  EXPECT_EQ(refusal("{}\n"), "line 1: found '{}'; expected 'grove-proof'");
  EXPECT_EQ(refusal("grove-proof 2\n"), "line 1: found '2'; expected '1'");
  EXPECT_EQ(refusal(head("maybe")), "line 3: found 'maybe'; expected yes or no");
  EXPECT_EQ(refusal(head() + "axiom\n"), "line 4: found 'axiom'; expected lemma or theorem");
  EXPECT_EQ(refusal(head() + "theorem -1\n"),
            "line 4: found '-1'; expected a cost or inf, from 0 to 1152921504606846975");
  EXPECT_EQ(refusal(head() + "theorem 4\nleaf\nend\n\n"),
            "line 6: found more after it; expected nothing after 'end'");
  EXPECT_EQ(refusal(head() + "lemma 3 1 1\n"),
            "line 4: found '1'; expected agents in ascending order");
  EXPECT_EQ(refusal(head() + "lemma 3 1\ndemand 0 bar 0 0 0\n"),
            "line 5: found '0 bar 0 0 0'; expected a constraint on an agent of the lemma");
  EXPECT_EQ(refusal(head() + "lemma 3 1\nleaf 0\n"),
            "line 5: found '0'; expected the number of an earlier lemma, of which there is none");
  EXPECT_EQ(refusal_of_proof("leaf\n"), "it was read");
  EXPECT_EQ(refusal_of_proof("leaf \n"),
            "line 5: found ''; expected the number of an earlier lemma, of which there is none");
  EXPECT_EQ(refusal_of_proof("leaf\r\n"),
            "line 5: found 'leaf\\x0d'; expected leaf or split or later or joint or prices or "
            "formula or choices");
  EXPECT_EQ(refusal_of_proof("joint 1\n"), "line 5: found '1'; expected the end of the line");
  EXPECT_EQ(refusal_of_proof("leaf\nleaf\n"), "line 6: found 'leaf'; expected 'end'");
  EXPECT_THAT(refusal_of_proof("split 0 bar 0 1 1 | 1 bar 0 1 1\nleaf\n"),
              EndsWith("line 7: found 'end'; expected leaf or split or later or joint or prices or "
                       "formula or choices"));
  EXPECT_EQ(refusal_of_proof("split 3 bar 0 1 1 | 1 bar 0 1 1\n"),
            "line 5: found '3'; expected the number of an agent, from 0 to 2");
  EXPECT_EQ(refusal_of_proof("split 0 bar 4 1 1 | 1 bar 0 1 1\n"),
            "line 5: found '4'; expected the number of a place, from 0 to 3");
  EXPECT_EQ(refusal_of_proof("split 0 bar 0  1 1 | 1 bar 0 1 1\n"),
            "line 5: found ''; expected a time, from 0 to 2147483647");
  EXPECT_EQ(refusal_of_proof("split 0 bar 0 1 1\n"), "line 5: the line ends; expected '|'");
  EXPECT_EQ(refusal_of_proof("split 0 jump 0 1 1 | 1 bar 0 1 1\n"),
            "line 5: found 'jump'; expected bar or move or norest or rest or pass or stop or "
            "nostop");
  EXPECT_EQ(refusal_of_proof("split 0 stop 0 1 | 0 nostop 0 1\n"),
            "line 5: found '1'; expected the number of a task, from 0 to 0");
  EXPECT_EQ(refusal_of_proof("later 0 1 2 1 0\n"),
            "line 5: found '2'; expected the number of an agent with a goal");
  EXPECT_EQ(refusal_of_proof("prices\nplace 0 1\nend\n"),
            "line 6: the line ends; expected a price, from 0 to 1152921504606846975");
  EXPECT_EQ(refusal_of_proof("prices\nswap 0 1\nend\n"),
            "line 6: found 'swap'; expected place or edge or finish or end");
  EXPECT_EQ(refusal_of_proof("formula\nwithin 0 0\nsum -1\ncore 0\nend\n"), "it was read");
  EXPECT_EQ(refusal_of_proof("formula\nwithin 0 0\nsum -2\nend\n"),
            "line 7: found '2'; expected the number of an earlier variable, or its negation");
  EXPECT_EQ(refusal_of_proof("formula\nclause\nwithin 0 0\nend\n"),
            "line 7: found 'within'; expected clause or drop or core or end");
  EXPECT_EQ(refusal_of_proof("formula\nclause\ndrop 1\nend\n"),
            "line 7: found '1'; expected the number of an earlier clause, from 0 to 0");
  EXPECT_EQ(
      refusal_of_proof("choices\ntask 0 3\ngoal 1 2\nformula\ncounts 0 0\nskips 1 0\nused 1 2\n"
                       "meets 0 rest 1 inf\nsum -1\natmost 0 1\nnode 0 1 1 0 1 since 1 end\nend\n"),
      "it was read");
  EXPECT_EQ(refusal_of_proof("choices\nwithin 0 0\n"),
            "line 6: found 'within'; expected task or goal or formula");
  EXPECT_EQ(refusal_of_proof("formula\ntask 0 3\nend\n"),
            "line 6: found 'task'; expected clause or drop or core or end");
  EXPECT_EQ(refusal_of_proof("formula\natmost 0 1\nend\n"),
            "line 6: found '0'; expected the number of an earlier sum, of which there is none");
  EXPECT_EQ(refusal_of_proof("split 0 rest 1 inf | 0 norest 1 2\n"),
            "line 5: found 'inf'; expected a time, from 0 to 2147483647");
  EXPECT_EQ(refusal_of_proof("formula\nnode 0 1 2 0 0 since 1 work\nend\n"),
            "line 6: found 'work'; expected the end of the line");
}

TEST_F(CertificateTexts, AreRefusedIfTooLarge) {
  EXPECT_EQ(refusal(head() + std::string(kAll), 4), "has 5 splits; expected at most 4");
  const std::string blanks(std::size_t{1} << 25, ' ');
  std::string bomb(ZSTD_compressBound(blanks.size()), '\0');
  bomb.resize(ZSTD_compress(bomb.data(), bomb.size(), blanks.data(), blanks.size(), 3));
  for (const std::string& large : {blanks, bomb})
    EXPECT_EQ(refusal(large),
              "is too large to be shown; expected a certificate of at most 16777216 bytes, "
              "uncompressed");
}

// A certificate with one changed byte must be either read or refused.
TEST_F(CertificateTexts, AreReadOrRefusedWithAnyByteChanged) {
  const std::string text = head() + std::string(kAll);
  std::size_t refused = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string changed = text;
    changed[at] = "0 9\n|x\xFF\0"[at % 8];
    try {
      EXPECT_EQ(read(changed).lines, changed);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("c.proof: line "));
      ++refused;
    }
  }
  EXPECT_GT(refused, text.size() / 2);
}

// A proof whose depth equals its number of splits.
TEST_F(CertificateTexts, CanBeDeeplyNested) {
  std::string proof;
  for (int i = 0; i < 100'000; ++i) proof += "split 0 bar 0 1 1 | 1 bar 0 1 1\nleaf\n";
  EXPECT_EQ(read(head() + "theorem 4\n" + proof + "leaf\nend\n", 100'000).bound, 4);
}

}  // namespace certificate_text_test
}  // namespace grove::detail
