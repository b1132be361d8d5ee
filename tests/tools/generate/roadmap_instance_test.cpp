// SPDX-License-Identifier: MIT
#include "tools/generate/roadmap_instance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "io/input_error.h"
#include "model/random.h"
#include "tests/tools/generate/reach.h"
#include "tools/generate/components.h"
#include "tools/generate/roadmap_generator.h"

namespace grove::detail {
namespace roadmap_instance_test {

Site hall() {
  return {"hall.roadmap.json",
          warehouse_roadmap({.aisles = 6, .slots = 10, .cross_aisles = 2, .bays = 3})};
}

Site town() {
  return {"town.roadmap.json", planar_roadmap({.vertices = 60, .one_way = 30, .seed = 1})};
}

const std::string& id(const Instance& instance, Place place) {
  return instance.roadmap()->vertices()[place].id;
}

std::set<Place> starts(const Instance& instance) {
  std::set<Place> places;
  for (const Agent& agent : instance.agents()) places.insert(agent.start);
  return places;
}

std::set<Place> goals(const Instance& instance) {
  std::set<Place> places;
  for (const Agent& agent : instance.agents()) places.insert(agent.goal.value());
  return places;
}

std::set<Place> cells(const Instance& instance) {
  std::set<Place> places;
  for (const Task& task : instance.tasks()) places.insert(task.cell);
  return places;
}

bool all_begin_with(const Instance& instance, const std::set<Place>& places, char letter) {
  return std::ranges::all_of(places, [&](Place p) { return id(instance, p).starts_with(letter); });
}

std::string refusal(const Site& site, const InstanceRequest& request) {
  try {
    generate_instance(site, request);
    return "accepted";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(RoadmapInstance, HasDistinctStartsGoalsAndTasks) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Instance instance = generate_instance(town(), {.agents = 20, .tasks = 40, .seed = seed});
    EXPECT_EQ(starts(instance).size(), 20U);
    EXPECT_EQ(goals(instance).size(), 20U);
    EXPECT_EQ(cells(instance).size(), 40U);
    for (const Agent& agent : instance.agents()) {
      EXPECT_NE(agent.start, agent.goal);
      EXPECT_FALSE(cells(instance).contains(agent.start));
    }
    for (const Task& task : instance.tasks()) {
      EXPECT_GE(task.agents.size(), 1U);
      EXPECT_LE(task.agents.size(), 3U);
    }
  }
}

TEST(RoadmapInstance, DependsOnTheSeed) {
  const InstanceRequest request{.agents = 5, .tasks = 10, .seed = 1};
  const auto starts_of = [](InstanceRequest r, std::uint64_t seed) {
    r.seed = seed;
    return starts(generate_instance(town(), r));
  };
  EXPECT_EQ(starts_of(request, 1), starts_of(request, 1));
  EXPECT_NE(starts_of(request, 1), starts_of(request, 2));
}

TEST(RoadmapInstance, PutsAgentsOnDeadEndsIfThereAreEnough) {
  const Instance instance = generate_instance(hall(), {.agents = 30, .tasks = 60});
  EXPECT_TRUE(all_begin_with(instance, starts(instance), 'p'));
  EXPECT_TRUE(all_begin_with(instance, goals(instance), 'p'));
  EXPECT_TRUE(std::ranges::none_of(cells(instance),
                                   [&](Place p) { return id(instance, p).starts_with('p'); }));
  const Instance more = generate_instance(hall(), {.agents = 31, .tasks = 60});
  EXPECT_FALSE(all_begin_with(more, starts(more), 'p'));
}

TEST(RoadmapInstance, SelectsVerticesByTheirIds) {
  Site site = hall();
  site.agents_on = "c";
  site.tasks_on = "a";
  const Instance instance = generate_instance(site, {.agents = 20, .tasks = 60});
  EXPECT_TRUE(all_begin_with(instance, starts(instance), 'c'));
  EXPECT_TRUE(all_begin_with(instance, goals(instance), 'c'));
  EXPECT_TRUE(all_begin_with(instance, cells(instance), 'a'));
  site.agents_on = "";
  const Instance anywhere = generate_instance(site, {.agents = 40, .tasks = 10});
  EXPECT_FALSE(all_begin_with(anywhere, starts(anywhere), 'p'));
}

TEST(RoadmapInstance, WithMgTurnsGoalsIntoTasks) {
  const Instance with_goals = generate_instance(hall(), {.agents = 10, .tasks = 20});
  const Instance mg = generate_instance(hall(), {.agents = 10, .tasks = 20, .mg = true});
  EXPECT_EQ(mg.task_count(), 30);
  for (AgentIndex i = 0; i < 10; ++i) {
    EXPECT_FALSE(mg.agent(i).goal);
    EXPECT_EQ(mg.task(mg.agent(i).tasks.back()).cell, with_goals.agent(i).goal);
  }
}

TEST(RoadmapInstance, DrawsDurations) {
  const Instance instance = generate_instance(
      hall(), {.agents = 10, .tasks = 60, .extras = {.durations = {.min = 2, .max = 4}}});
  std::set<Time> durations;
  for (const Task& task : instance.tasks()) durations.insert(task.duration);
  EXPECT_EQ(durations, (std::set<Time>{2, 3, 4}));
}

TEST(RoadmapInstance, DrawsChoices) {
  const Instance plain = generate_instance(hall(), {.agents = 10, .tasks = 70});
  const Instance instance = generate_instance(
      hall(), {.agents = 10,
               .tasks = 70,
               .choices = {.need = 2, .goals = GoalChoice::kGroups, .goal_count = 2}});
  for (const Task& task : instance.tasks()) {
    EXPECT_EQ(task.need, 2);
    EXPECT_EQ(task.agents.size(), 10U);
  }
  EXPECT_EQ(cells(instance), cells(plain));
  for (AgentIndex i = 0; i < 10; ++i) {
    EXPECT_EQ(instance.agent(i).goals.size(), 5U);
    EXPECT_EQ(std::ranges::count(instance.agent(i).goals, plain.agent(i).goal.value()), 1);
  }
}

TEST(RoadmapInstance, UsesTheLargestStrongComponent) {
  // A ring of four vertices, a ring of three from which it can be reached, and a ring of three that
  // can be reached from it.
  std::vector<Vertex> vertices;
  for (int k = 0; k < 10; ++k)
    vertices.push_back({fmt::format("{}{}", k < 3 ? "in" : k < 7 ? "ring" : "out", k), {}});
  const auto road = [](int from, int to) { return Road{from, to, 3, true}; };
  const Roadmap roadmap(
      vertices, {road(0, 1), road(1, 2), road(2, 0), road(2, 3), road(3, 4), road(4, 5), road(5, 6),
                 road(6, 3), road(4, 7), road(7, 8), road(8, 9), road(9, 7)});
  const Site site{"rings.roadmap.json", roadmap};
  const Instance instance = generate_instance(site, {.agents = 2, .tasks = 2});
  for (const auto& places : {starts(instance), goals(instance), cells(instance)})
    EXPECT_TRUE(all_begin_with(instance, places, 'r'));
  EXPECT_EQ(refusal(site, {.agents = 5}),
            "rings.roadmap.json: has 4 vertices that can all reach each other; expected at least 5 "
            "for 5 agents");
}

TEST(RoadmapInstance, RefusesTooLargeCounts) {
  Site site = hall();
  site.agents_on = "p";
  EXPECT_EQ(refusal(site, {.agents = 31}),
            "hall.roadmap.json: has 30 vertices whose ids begin with 'p' that can all reach each "
            "other; expected at least 31 for 31 agents");
  site.tasks_on = "p";
  EXPECT_EQ(refusal(site, {.agents = 20, .tasks = 11}),
            "hall.roadmap.json: has 10 vertices whose ids begin with 'p' that can all reach each "
            "other and where no agent starts; expected at least 11 for 11 tasks");
  EXPECT_EQ(refusal(hall(), {.agents = 1, .tasks = 70}),
            "hall.roadmap.json: 70 tasks for 1 agents do not fit: agent 'a0' must visit more "
            "than 64 tasks; expected at most 64");
}

// Compares the result with the reachability of each vertex.
TEST(LargestStrongComponent, IsTheFirstOfTheLargest) {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    const int count = 1 + random.below(9);
    std::vector<Vertex> vertices;
    for (int k = 0; k < count; ++k) vertices.push_back({std::to_string(k), {}});
    std::vector<Road> roads;
    for (int k = random.below(2 * count); k > 0; --k) {
      const Road road{random.below(count), random.below(count), 1, random.below(4) > 0};
      if (road.from != road.to) roads.push_back(road);
    }
    const Roadmap roadmap(vertices, roads);
    std::vector<int> largest;
    for (int v = 0; v < count; ++v) {
      std::vector<int> part;
      std::ranges::set_intersection(reached_from(roadmap, v), reaching(roadmap, v),
                                    std::back_inserter(part));
      if (part.size() > largest.size()) largest = part;
    }
    EXPECT_EQ(largest_strong_component(roadmap), largest) << round;
  }
}

}  // namespace roadmap_instance_test
}  // namespace grove::detail
