// SPDX-License-Identifier: MIT
#include "batch/instance_facts.h"

#include <gtest/gtest.h>

#include "tests/support/choices.h"
#include "tests/support/instances.h"

namespace grove::detail::batch {
namespace instance_facts_test {

using grove::detail::testing::AgentSpec;
using grove::detail::testing::instance_of;

InstanceMetadata facts(const std::string& id, const std::vector<AgentSpec>& agents) {
  return metadata_of({.id = id, .path = ""},
                     {instance_of({"....", "...."}, agents), "x/room-32.map", {}});
}

TEST(InstanceMetadata, AreReadFromTheInstanceAndItsName) {
  const AgentSpec with_goal{{0, 0}, Position{3, 0}, {{1, 1}, {2, 1}}};
  const AgentSpec free{{1, 0}, std::nullopt, {{2, 0}}};
  EXPECT_EQ(facts("set/room_s12_n1_m2", {with_goal}),
            (InstanceMetadata{"room-32", 12, 1, 2, "cts"}));
  EXPECT_EQ(facts("anything", {with_goal, free}),
            (InstanceMetadata{"room-32", std::nullopt, 2, 3, "mixed"}));
  EXPECT_EQ(facts("a_s3_x", {free}), (InstanceMetadata{"room-32", 3, 1, 1, "mg"}));
  EXPECT_EQ(facts("_s3_n1_m9/x", {{{0, 0}, Position{3, 0}}}),
            (InstanceMetadata{"room-32", std::nullopt, 1, 0, "mapf"}));
}

// All tasks and agents count, also tasks that some agents only may visit.
TEST(InstanceMetadata, NameChoices) {
  const auto facts = [](Instance instance) {
    return metadata_of({.id = "x", .path = ""}, {std::move(instance), "x/m.map", {}});
  };
  EXPECT_EQ(facts(grove::detail::testing::instance_with_goals()),
            (InstanceMetadata{"m", std::nullopt, 2, 0, "choices"}));
  EXPECT_EQ(facts(grove::detail::testing::instance_with_need()),
            (InstanceMetadata{"m", std::nullopt, 2, 1, "choices"}));
}

// In an MG-MAPF instance the former destination counts as one more task.
TEST(InstanceMetadata, TakeTheNumberOfTasksFromTheName) {
  const AgentSpec free{{1, 0}, std::nullopt, {{2, 0}, {3, 1}}};
  EXPECT_EQ(facts("room_s1_n1_m1_mg", {free}).tasks, 1);
  EXPECT_EQ(facts("room_s1_n1_m1", {free}).tasks, 1);
  for (const char* other :
       {"room_s1_n1_mX_mg", "room_s1_m1_n1", "room_n1_m1", "s1_n1_m1", "room_s1"})
    EXPECT_EQ(facts(other, {free}).tasks, 2) << other;
}

TEST(InstanceMetadata, ReadTheScenarioNumberFromTheName) {
  const AgentSpec agent{{0, 0}, Position{3, 0}};
  EXPECT_EQ(facts("a_small_set_s07_n1", {agent}).scenario, 7);
  for (const char* other :
       {"a_s_n1", "a_s1", "s1_n1", "a_s-1_n1", "a_s1x_n1", "a_s99999999999999999999_n1", "", "_"})
    EXPECT_EQ(facts(other, {agent}).scenario, std::nullopt) << other;
}

TEST(InstanceMetadata, ReadScenarioNumbersOfMovingAiNames) {
  const AgentSpec agent{{0, 0}, Position{3, 0}};
  EXPECT_EQ(facts("den312d-random-3-50", {agent}).scenario, 3);
  EXPECT_EQ(facts("scen-even/den312d-even-12", {agent}).scenario, 12);
  EXPECT_EQ(facts("random-32-32-20-random-7-50", {agent}).scenario, 7);
  for (const char* other : {"random-32-32-20-50", "den312d-random-", "den312d-odd-3-50"})
    EXPECT_EQ(facts(other, {agent}).scenario, std::nullopt) << other;
}

}  // namespace instance_facts_test
}  // namespace grove::detail::batch
