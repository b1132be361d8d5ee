// SPDX-License-Identifier: MIT
#include "batch/false_claims.h"

#include <gtest/gtest.h>

#include "tests/support/result_rows.h"

namespace grove::detail::batch {
namespace false_claims_test {

using grove::detail::testing::solved_row;

Row row_of_grove(Cost cost, Cost lower_bound) {
  Row row = solved_row("i", "grove");
  row.outcome.cost = cost;
  row.outcome.lower_bound = lower_bound;
  return row;
}

Row row_of_other(const std::string& method) {
  Row row = solved_row("i", method);
  row.solver = "x";
  row.outcome = {.status = "feasible", .solved = true};
  return row;
}

// A row whose paths cost 105 and which claims this cost and a lower bound of 100.
Row honest_row() {
  Row row = row_of_other("honest");
  row.outcome.cost = row.outcome.claimed_cost = 105;
  row.outcome.claimed_lower_bound = 100;
  return row;
}

TEST(FalseClaims, DoNotIncludeConsistentClaims) {
  const std::vector<Row> rows{row_of_grove(104, 104), honest_row()};
  EXPECT_TRUE(false_claims(rows).empty());
  EXPECT_TRUE(false_claims({}).empty());
  Row counts_otherwise = honest_row();
  counts_otherwise.outcome.claimed_cost = 120;
  EXPECT_TRUE(false_claims({&counts_otherwise, 1}).empty());
}

TEST(FalseClaims, IncludeCostsBelowThoseOfThePaths) {
  Row row = honest_row();
  row.outcome.claimed_cost = 104;
  EXPECT_EQ(false_claims({&row, 1}),
            (std::vector<FalseClaim>{
                {"honest", "i", "claims a cost of 104, but its own paths cost 105"}}));
}

TEST(FalseClaims, IncludeCostsBelowAProvenBound) {
  Row row = row_of_other("claimer");
  row.outcome = {.status = kClaimed, .error = "claims", .claimed_cost = 99};
  const std::vector<Row> rows{row, row_of_grove(110, 100), row_of_grove(120, 90)};
  EXPECT_EQ(false_claims(rows),
            (std::vector<FalseClaim>{{"claimer", "i",
                                      "claims a cost of 99, but grove has proven that no plan "
                                      "costs less than 100"}}));
  row.outcome.claimed_cost = 100;
  EXPECT_TRUE(false_claims(std::vector<Row>{row, row_of_grove(110, 100)}).empty());
}

TEST(FalseClaims, IncludeBoundsAboveTheCostOfAPlan) {
  Row row = row_of_other("bounder");
  row.outcome = {.error = "time limit", .claimed_lower_bound = 106};
  EXPECT_EQ(false_claims(std::vector<Row>{row, honest_row(), row_of_grove(110, 100)}),
            (std::vector<FalseClaim>{{"bounder", "i",
                                      "claims a lower bound of 106, but honest has a plan that "
                                      "costs 105"}}));
}

// Grove's own bounds are checked as well.
TEST(FalseClaims, IncludeGrovesOwnBounds) {
  EXPECT_EQ(false_claims(std::vector<Row>{row_of_grove(110, 110), honest_row()}),
            (std::vector<FalseClaim>{{"grove", "i",
                                      "proves a lower bound of 110, but honest has a plan that "
                                      "costs 105"}}));
}

TEST(FalseClaims, IncludeProofsOfInfeasibilityIfThereIsAPlan) {
  Row infeasible = solved_row("i", "grove");
  infeasible.outcome = {.status = "infeasible"};
  EXPECT_EQ(
      false_claims(std::vector<Row>{infeasible, honest_row()}),
      (std::vector<FalseClaim>{
          {"grove", "i", "proves that there is no plan, but honest has one that costs 105"}}));
  Row claimer = row_of_other("claimer");
  claimer.outcome = {.status = kClaimed, .error = "claims"};
  EXPECT_EQ(false_claims(std::vector<Row>{infeasible, claimer}),
            (std::vector<FalseClaim>{
                {"claimer", "i", "claims a plan, but grove has proven that there is none"}}));
  EXPECT_TRUE(false_claims({&infeasible, 1}).empty());
}

TEST(FalseClaims, CompareRowsOfOneInstanceOnly) {
  Row other = honest_row();
  other.run.digest = "another";
  EXPECT_TRUE(false_claims(std::vector<Row>{row_of_grove(110, 110), other}).empty());
  other = honest_row();
  other.run.instance = "j";
  EXPECT_TRUE(false_claims(std::vector<Row>{row_of_grove(110, 110), other}).empty());
}

// A bound from another solver is only a claim, so it refutes no other claim.
TEST(FalseClaims, AreNotDerivedFromUncheckedClaims) {
  Row bounder = row_of_other("bounder");
  bounder.outcome.claimed_lower_bound = 90;
  Row cheap = row_of_other("cheap");
  cheap.outcome.claimed_cost = 80;
  EXPECT_TRUE(false_claims(std::vector<Row>{bounder, cheap}).empty());
}

}  // namespace false_claims_test
}  // namespace grove::detail::batch
