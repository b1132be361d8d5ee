// SPDX-License-Identifier: MIT
#include "occupancy_planning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace grove_ros2 {
namespace occupancy_planning_test {

using std::numbers::pi;

// Returns a map from rows, top to bottom: '.' free, '#' occupied, '?' unknown. A pixel is 10 cm
// wide.
Occupancy occupancy(const std::vector<std::string>& rows, Pose2d origin = {}) {
  Occupancy map{.width = static_cast<int>(rows[0].size()),
                .height = static_cast<int>(rows.size()),
                .resolution = 0.1,
                .origin = origin,
                .data = {}};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char pixel : *row)
      map.data.push_back(pixel == '.' ? std::int8_t{0}
                                      : (pixel == '#' ? std::int8_t{100} : std::int8_t{-1}));
  return map;
}

const std::vector<std::string> kRows{"....#.", "......", "..?...", "......"};

std::string refusal(const auto& act) {
  try {
    act();
  } catch (const grove::InvalidArgument& error) {
    return error.field();
  }
  return "none";
}

TEST(OccupancyPlanning, CellIsFreeIfAllItsPixelsAre) {
  const PlanningGrid grid(occupancy(kRows), 0.2);
  ASSERT_EQ(grid.world().width(), 3);
  ASSERT_EQ(grid.world().height(), 2);
  const std::vector<std::vector<bool>> passable{{true, true, false}, {true, false, true}};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      EXPECT_EQ(grid.world().passable({x, y}),
                passable[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)])
          << x << ' ' << y;
}

TEST(OccupancyPlanning, CellIsAtLeastAsLargeAsRequested) {
  EXPECT_DOUBLE_EQ(PlanningGrid(occupancy(kRows), 0.2).cell_size(), 0.2);
  EXPECT_DOUBLE_EQ(PlanningGrid(occupancy(kRows), 0.21).cell_size(), 0.1 * 3);
  EXPECT_DOUBLE_EQ(PlanningGrid(occupancy(kRows), 0.01).cell_size(), 0.1);
}

TEST(OccupancyPlanning, CellAndItsMiddleAreInverse) {
  for (const double yaw : {0.0, 0.3, pi / 2, -2.5}) {
    const PlanningGrid grid(occupancy(kRows, {.x = -3, .y = 7, .yaw = yaw}), 0.1);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 6; ++x)
        if (grid.world().passable({x, y})) {
          EXPECT_EQ(grid.cell_at(grid.middle({x, y}), "f"), (grove::Cell{x, y}));
        }
  }
}

TEST(OccupancyPlanning, OriginIsTheLowerLeftCorner) {
  const PlanningGrid grid(occupancy(kRows, {.x = 1, .y = 2}), 0.1);
  EXPECT_EQ(grid.cell_at({.x = 1.05, .y = 2.05}, "f"), (grove::Cell{0, 3}));
  EXPECT_EQ(grid.cell_at({.x = 1.55, .y = 2.35}, "f"), (grove::Cell{5, 0}));
  const Pose2d middle = grid.middle({0, 3});
  EXPECT_NEAR(middle.x, 1.05, 1e-9);
  EXPECT_NEAR(middle.y, 2.05, 1e-9);
  // In a map rotated by 90 degrees the x axis points up.
  const PlanningGrid turned(occupancy(kRows, {.x = 1, .y = 2, .yaw = pi / 2}), 0.1);
  EXPECT_EQ(turned.cell_at({.x = 0.95, .y = 2.55}, "f"), (grove::Cell{5, 3}));
}

TEST(OccupancyPlanning, ErrorsNameTheField) {
  const PlanningGrid grid(occupancy(kRows), 0.1);
  const auto errand = [&](std::vector<Pose2d> places) {
    return refusal([&] { instance_of(grid, {{.robot = "a", .places = places}}); });
  };
  const Pose2d free{.x = 0.05, .y = 0.05};
  EXPECT_EQ(errand({}), "a");
  EXPECT_EQ(errand({free, {.x = 0.45, .y = 0.35}, free}), "a/1");  // occupied
  EXPECT_EQ(errand({free, free, {.x = 0.25, .y = 0.15}}), "a/2");  // unknown
  EXPECT_EQ(errand({{.x = -0.01, .y = 0.05}}), "a/0");             // outside
  EXPECT_EQ(errand({{.x = std::nan(""), .y = 0.05}}), "a/0");
  EXPECT_EQ(errand({free, free}), "none");
  EXPECT_EQ(refusal([] { PlanningGrid(occupancy(kRows), 0.5); }), "/cell");
  EXPECT_EQ(refusal([] { PlanningGrid(occupancy(kRows), 0); }), "/cell");
  EXPECT_EQ(refusal([] {
              Occupancy map = occupancy(kRows);
              map.data.pop_back();
              PlanningGrid(map, 0.1);
            }),
            "/map");
}

TEST(OccupancyPlanning, PlanVisitsAllPlaces) {
  const PlanningGrid grid(occupancy(kRows, {.x = -1, .y = -1, .yaw = 0.7}), 0.1);
  const std::vector<Errand> errands{
      {.robot = "a",
       .places = {grid.middle({0, 0}), grid.middle({3, 3}), grid.middle({1, 3}),
                  grid.middle({5, 0})}},
      {.robot = "b", .places = {grid.middle({5, 2}), grid.middle({0, 1})}},
      {.robot = "c", .places = {grid.middle({4, 2})}}};
  const grove::Instance instance = instance_of(grid, errands);
  ASSERT_EQ(instance.tasks().size(), 2U);
  const grove::Solution solution = grove::solve(instance);
  ASSERT_EQ(solution.status, grove::Status::optimal);
  EXPECT_TRUE(grove::check(instance, solution).empty());
  for (std::size_t robot = 0; robot < errands.size(); ++robot) {
    const auto path = waypoints(grid, solution.plan->agents[robot], 2.0);
    ASSERT_FALSE(path.empty());
    const auto is_at = [&](const Pose2d& at, const Pose2d& place) {
      return std::hypot(at.x - place.x, at.y - place.y) < 1e-9;
    };
    EXPECT_TRUE(is_at(path.front().pose, errands[robot].places.front()));
    EXPECT_TRUE(is_at(path.back().pose, errands[robot].places.back()));
    for (const Pose2d& place : errands[robot].places)
      EXPECT_TRUE(std::any_of(path.begin(), path.end(),
                              [&](const Waypoint& w) { return is_at(w.pose, place); }));
    for (std::size_t i = 0; i < path.size(); ++i) {
      EXPECT_DOUBLE_EQ(path[i].seconds, 2.0 * static_cast<double>(i));
      if (i + 1 == path.size()) break;
      const double dx = path[i + 1].pose.x - path[i].pose.x;
      const double dy = path[i + 1].pose.y - path[i].pose.y;
      if (std::hypot(dx, dy) < 1e-9) continue;
      EXPECT_NEAR(std::hypot(dx, dy), 0.1, 1e-9);
      EXPECT_NEAR(std::cos(path[i].pose.yaw) * dy, std::sin(path[i].pose.yaw) * dx, 1e-9);
      EXPECT_GT(std::cos(path[i].pose.yaw) * dx + std::sin(path[i].pose.yaw) * dy, 0);
    }
  }
}

// The robot faces the direction of its next move, also while it waits. After its last move it keeps
// its direction.
TEST(OccupancyPlanning, RobotFacesItsNextMove) {
  const PlanningGrid grid(occupancy(kRows), 0.1);
  const auto at = [](int x, int y) { return grove::Pose{.place = grove::Cell{x, y}}; };
  const grove::AgentPlan plan{.id = "a",
                              .path = {at(0, 0), at(0, 0), at(0, 1), at(1, 1), at(1, 1)}};
  const auto path = waypoints(grid, plan, 1);
  const std::vector<double> yaws{-pi / 2, -pi / 2, 0, 0, 0};
  for (std::size_t i = 0; i < yaws.size(); ++i) EXPECT_NEAR(path[i].pose.yaw, yaws[i], 1e-9) << i;
  EXPECT_EQ(waypoints(grid, {.id = "a", .path = {at(0, 0)}}, 1).size(), 1U);
}

}  // namespace occupancy_planning_test
}  // namespace grove_ros2
