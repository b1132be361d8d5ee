// SPDX-License-Identifier: MIT
#include "proof/certificate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "io/input_error.h"
#include "proof/proof_parts.h"
#include "tests/support/choices.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Two agents that must pass each other on a 3 x 2 grid. The first agent has two tasks.
Instance two_agents() {
  InstanceBuilder builder{Map(Grid(3, 2, std::vector<bool>(6, true)))};
  builder.add_agent("a", Position{0, 0}, Position{2, 0});
  builder.add_agent("b", Position{2, 0}, Position{0, 0});
  const std::vector<std::string> a{"a"};
  builder.add_task("s", Position{1, 1}, a);
  builder.add_task("t", Position{1, 0}, a);
  return std::move(builder).build();
}

AgentConstraint bar(AgentIndex agent, Place place, Time begin, Time end) {
  return {agent, {place, kNoPlace, begin, end, ConstraintKind::kVertexOrEdge}};
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string packed{std::istreambuf_iterator<char>(in), {}};
  std::string text(1 << 16, '\0');
  ZSTD_DCtx* const context = ZSTD_createDCtx();
  ZSTD_inBuffer from{packed.data(), packed.size(), 0};
  ZSTD_outBuffer to{text.data(), text.size(), 0};
  EXPECT_FALSE(ZSTD_isError(ZSTD_decompressStream(context, &to, &from)));
  ZSTD_freeDCtx(context);
  text.resize(to.pos);
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class Certificates : public ::testing::Test {
 protected:
  // Returns the lines of the certificate made from the records so far, without its head.
  std::vector<std::string> made(Cost claimed) {
    recorder_.flush();
    certificate_ = write_certificate(instance_, std::array{part_}, claimed, file_);
    std::vector<std::string> lines = lines_of(file_);
    EXPECT_EQ(lines.at(0), "grove-proof 1");
    EXPECT_TRUE(lines.at(1).starts_with("instance "));
    EXPECT_EQ(lines.at(2), "following yes");
    lines.erase(lines.begin(), lines.begin() + 3);
    return lines;
  }

  const TemporaryDirectory folder_;
  const fs::path part_ = folder_ / "part";
  const fs::path file_ = folder_ / "certificate";
  const Instance instance_ = two_agents();
  ProofRecorder recorder_{part_};
  const ProofTree tree_{7, 4, {{}, {}}};
  Certificate certificate_;
};

TEST_F(Certificates, OfAnUnexpandedRootHoldOneLeaf) {
  recorder_.tree(tree_);
  EXPECT_THAT(made(4), ElementsAre("theorem 4", "leaf", "end"));
}

TEST_F(Certificates, HoldOnlyTheSplitsThatTheBoundNeeds) {
  recorder_.tree(tree_);
  const Split first{bar(0, 1, 1, 1), bar(1, 1, 1, 1)};
  const Split second{bar(0, 4, 2, 2), bar(1, 4, 2, 2)};
  recorder_.split({7, first, {5, 5}});
  recorder_.split({proof_key(7, first[0]), second, {6, 6}});
  recorder_.split({proof_key(7, first[1]), second, {5, 6}});
  EXPECT_THAT(made(6),
              ElementsAre("theorem 5", "split 0 bar 1 1 1 | 1 bar 1 1 1", "leaf", "leaf", "end"));
  EXPECT_EQ(certificate_.bound, 5) << "because no more was recorded";
  EXPECT_EQ(certificate_.splits, 1);
  EXPECT_EQ(certificate_.leaves, 2);
}

TEST_F(Certificates, HoldOnlyTheLemmasThatTheBoundNeeds) {
  recorder_.tree(tree_);
  const ProofLemma joint{{0, 1}, {bar(1, 2, 3, kNever)}, 6};
  const ProofLemma idle{{0, 1}, {}, 5};
  recorder_.lemma(idle, kNoProof, {});
  const Split split{bar(0, 1, 1, 1), bar(1, 1, 1, 1)};
  const std::array splits{ProofSplit{9, split, {6, 6}}};
  recorder_.lemma(joint, 9, splits);
  recorder_.bound(
      7, 4, 6, std::array{ProofExcess{idle.key(), {0, 1}, 1}, ProofExcess{joint.key(), {0, 1}, 2}});
  EXPECT_THAT(made(6),
              ElementsAre("lemma 6 0 1", "demand 1 bar 2 3 inf", "split 0 bar 1 1 1 | 1 bar 1 1 1",
                          "leaf", "leaf", "theorem 6", "leaf 0", "end"));
  EXPECT_EQ(certificate_.lemmas, 1);
}

TEST_F(Certificates, OmitLostLemmas) {
  recorder_.tree(tree_);
  const ProofLemma lemma{{0, 1}, {}, 5};
  recorder_.lemma(lemma, kNoProof, {});
  recorder_.bound(7, 4, 6,
                  std::array{ProofExcess{lemma.key(), {0, 1}, 1}, ProofExcess{123, {0, 1}, 2}});
  EXPECT_THAT(made(6), ElementsAre("lemma 5 0 1", "joint", "theorem 5", "leaf 0", "end"));
}

TEST_F(Certificates, JustifySplitsOnCostsByALemma) {
  recorder_.tree(tree_);
  const ProofLemma lemma{{0, 1}, {}, 5};
  recorder_.lemma(lemma, kNoProof, {});
  const auto later = [](AgentIndex agent, Place goal) {
    return AgentConstraint{agent, {goal, kNoPlace, 0, 2, ConstraintKind::kNoRestBy}};
  };
  recorder_.split({7, {later(0, 2), later(1, 0)}, {5, 5}, lemma.key()});
  EXPECT_THAT(made(5), ElementsAre("lemma 5 0 1", "joint", "theorem 5", "later 0 2 1 2 0", "leaf",
                                   "leaf", "end"));
}

TEST_F(Certificates, SplitStopByStopDownToTheTrees) {
  recorder_.tree({11, 6, {{0, 1}, {}}});
  recorder_.tree({12, 6, {{1, 0}, {}}});
  EXPECT_THAT(
      made(6),
      ElementsAre("theorem 6", "split 0 stop 0 0 | 0 nostop 0 0", "split 0 stop 1 1 | 0 nostop 1 1",
                  "leaf", "leaf", "split 0 stop 0 1 | 0 nostop 0 1",
                  "split 0 stop 1 0 | 0 nostop 1 0", "leaf", "leaf", "leaf", "end"));
}

TEST_F(Certificates, UsePricesIfTheyProveMore) {
  recorder_.tree(tree_);
  using Kind = RelaxedRow::Kind;
  recorder_.prices(5, std::array{RowMultiplier{{Kind::kPlace, 1, 0, 2, 0}, 700},
                                 RowMultiplier{{Kind::kEdge, 0, 1, 1, 0}, 3},
                                 RowMultiplier{{Kind::kFinish, 0, 1, 4, 5}, 9}});
  EXPECT_THAT(made(5), ElementsAre("theorem 5", "prices", "place 1 2 700", "edge 0 1 1 3",
                                   "finish 0 4 1 5 9", "end", "end"));
  EXPECT_THAT(made(4), ElementsAre("theorem 4", "leaf", "end"));
}

// The lines of an earlier formula, and those after the bound, are not part of the certificate.
TEST_F(Certificates, UseAFormulaUpToTheBoundThatTheyNeed) {
  recorder_.tree(tree_);
  using Kind = FormulaKind;
  const auto log = [&](Kind kind, std::vector<std::int64_t> numbers) {
    recorder_.formula(kind, numbers);
  };
  log(Kind::kBegin, {});
  log(Kind::kWithin, {1, 0});
  log(Kind::kBegin, {});
  log(Kind::kAgent, {0, 2});
  log(Kind::kWithin, {0, 1});
  log(Kind::kClause, {-1});
  log(Kind::kRests, {0, 3, kNever});
  log(Kind::kNode, {0, 4, 3, 0, 2, -1, 0, -1, 0});
  log(Kind::kNode, {0, 5, 3, 1, 2, 1, 3, 4, 0});
  log(Kind::kMeets, {1, 2, 1, 0, kNever, 0});
  log(Kind::kSum, {-1, 2});
  log(Kind::kCount, {0, 0, 2, 2});
  log(Kind::kCore, {0});
  recorder_.formula_bound(5);
  log(Kind::kDrop, {0});
  log(Kind::kActive, {1});
  log(Kind::kCore, {0});
  recorder_.formula_bound(6);
  const std::vector<std::string> lines{"theorem 5",
                                       "formula",
                                       "agent 0 2",
                                       "within 0 1",
                                       "rests 0 3 inf",
                                       "node 0 4 3 0 2",
                                       "node 0 5 3 1 2 work 1 3 since 4",
                                       "meets 1 move 1 2 0 inf",
                                       "sum -1 2",
                                       "count 0 0 2 2",
                                       "clause -1",
                                       "core 0",
                                       "end",
                                       "end"};
  EXPECT_EQ(made(5), lines);
  EXPECT_THAT(made(4), ElementsAre("theorem 4", "leaf", "end"));
  EXPECT_EQ(made(6).size(), lines.size() + 3);
  EXPECT_EQ(made(7).front(), "theorem 6");
}

TEST_F(Certificates, OfChoicesBeginWithTheirPrices) {
  using Kind = FormulaKind;
  const auto log = [&](Kind kind, std::vector<std::int64_t> numbers) {
    recorder_.formula(kind, numbers);
  };
  log(Kind::kBegin, {});
  log(Kind::kTask, {0, 7});  // of an earlier formula
  log(Kind::kBegin, {});
  log(Kind::kTask, {0, 2});
  log(Kind::kGoal, {3, 1});
  log(Kind::kCounts, {0, 0});
  log(Kind::kSkips, {1, 0});
  log(Kind::kUsed, {3, 1});
  log(Kind::kSum, {-1, -2});
  log(Kind::kAtMost, {0, 1});
  log(Kind::kNode, {0, 4, 3, 0, 1, -1, 0, 4, 1});
  log(Kind::kMeets, {1, 3, kNoCell, 0, kNever, static_cast<std::int64_t>(ConstraintKind::kRestBy)});
  recorder_.formula_bound(4);
  recorder_.flush();
  const Instance instance = testing::instance_with_need();
  EXPECT_EQ(write_certificate(instance, std::array{part_}, 5, file_).bound, 4);
  const std::vector<std::string> lines = lines_of(file_);
  EXPECT_THAT(std::vector(lines.begin() + 3, lines.end()),
              ElementsAre("theorem 4", "choices", "task 0 2", "goal 3 1", "formula", "counts 0 0",
                          "skips 1 0", "used 3 1", "sum -1 -2", "atmost 0 1",
                          "node 0 4 3 0 1 since 4 end", "meets 1 rest 3 inf", "end", "end"));
}

TEST_F(Certificates, OfAPresolvedInstanceAskForAllJointPaths) {
  EXPECT_THAT(made(kInfiniteCost), ElementsAre("theorem inf", "joint", "end"));
}

TEST_F(Certificates, AreNotMadeFromInvalidRecordFiles) {
  std::ofstream(folder_ / "other") << "anything";
  EXPECT_THROW(write_certificate(instance_, std::array{fs::path(folder_ / "other")}, 4, file_),
               InputError);
  EXPECT_THROW(write_certificate(instance_, std::array{fs::path(folder_ / "none")}, 4, file_),
               InputError);
  EXPECT_FALSE(fs::exists(file_));
}

// A record that a killed process wrote only in part is ignored; complete records are used.
TEST_F(Certificates, OfTruncatedRecordsUseTheCompleteOnes) {
  recorder_.tree(tree_);
  recorder_.flush();
  recorder_.split({7, {bar(0, 1, 1, 1), bar(1, 1, 1, 1)}, {5, 5}});
  recorder_.flush();
  fs::resize_file(part_, fs::file_size(part_) - 5);
  const auto made = write_certificate(instance_, std::array{part_}, 5, file_);
  EXPECT_EQ(made.bound, 4);
}

TEST_F(Certificates, NameTheInstance) {
  InstanceBuilder other = InstanceBuilder::like(instance_);
  other.add_agent("a", Position{0, 0}, Position{2, 0});
  EXPECT_NE(certificate_checksum(std::move(other).build()), certificate_checksum(instance_));
}

TEST_F(Certificates, ChecksumsCoverChoices) {
  const auto checksum = [](std::vector<Place> goals, std::optional<int> need) {
    InstanceBuilder builder{Map(Grid(3, 2, std::vector<bool>(6, true)))};
    builder.add_agent({.id = "a", .start = {.place = 0}, .goal = {}, .goals = std::move(goals)});
    builder.add_agent("b", Place{2}, std::nullopt);
    builder.add_agent("c", Place{5}, std::nullopt);
    builder.add_task("t", Place{4}, std::vector<std::string>{"a", "b", "c"}, 0, need);
    return certificate_checksum(std::move(builder).build());
  };
  const std::vector<std::uint64_t> sums{checksum({}, {}),     checksum({}, 1),
                                        checksum({}, 2),      checksum({3}, {}),
                                        checksum({3, 4}, {}), checksum({4, 3}, 1)};
  for (std::size_t i = 0; i < sums.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(sums[i], sums[k]) << i << " " << k;
  EXPECT_EQ(checksum({}, 3), checksum({}, {}));
}

TEST_F(Certificates, ClaimNothingAboutChoicesWithoutFormula) {
  recorder_.flush();
  for (const Instance& instance : {testing::instance_with_goals(), testing::instance_with_need()})
    EXPECT_EQ(write_certificate(instance, std::array{part_}, 4, file_).bound, 0);
}

}  // namespace
}  // namespace grove::detail
