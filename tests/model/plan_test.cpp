// SPDX-License-Identifier: MIT
#include "grove/model/plan.h"

#include <gtest/gtest.h>

namespace grove {
namespace plan_test {

TEST(Status, FollowsFromCostBoundAndOmega) {
  const Omega one_percent = Omega::parse("0.01");
  EXPECT_EQ(status_of(std::nullopt, 10, one_percent), Status::kUnknown);
  EXPECT_EQ(status_of(100, 100, one_percent), Status::kOptimal);
  EXPECT_EQ(status_of(101, 100, one_percent), Status::kBounded);
  EXPECT_EQ(status_of(102, 100, one_percent), Status::kFeasible);
  EXPECT_EQ(status_of(100, 99, Omega()), Status::kFeasible);
}

TEST(Status, WithInfiniteOmegaIsBoundedByNothing) {
  EXPECT_EQ(status_of(101, 100, Omega::infinite()), Status::kFeasible);
  EXPECT_EQ(status_of(100, 100, Omega::infinite()), Status::kOptimal);
}

TEST(Status, NamesRoundTrip) {
  for (Status status : {Status::kOptimal, Status::kBounded, Status::kFeasible, Status::kInfeasible,
                        Status::kUnknown})
    EXPECT_EQ(parse_status(to_string(status)), status);
  EXPECT_FALSE(parse_status("solved"));
}

}  // namespace plan_test
}  // namespace grove
