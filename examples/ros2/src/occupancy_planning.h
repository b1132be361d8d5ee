// SPDX-License-Identifier: MIT
// From an occupancy grid and poses in metres to a Grove instance, and from its plan back to poses
// with times. Knows nothing of ROS, so that it can be tried without.
#pragma once

#include <cstdint>
#include <grove/grove.hpp>
#include <string>
#include <vector>

namespace grove_ros2 {

// In the map's frame, metres and radians.
struct Pose2d {
  double x = 0;
  double y = 0;
  double yaw = 0;
};

// As nav_msgs/OccupancyGrid has it: row by row from the lowest, 0 is free, 100 occupied, -1
// unknown.
struct Occupancy {
  int width = 0;
  int height = 0;
  double resolution = 0;  // metres a pixel
  Pose2d origin;          // the lower left corner of pixel (0, 0)
  std::vector<std::int8_t> data;
};

// What one robot is to do: it is at the first place, is to visit those between in any order, and
// ends at the last.
struct Errand {
  std::string robot;
  std::vector<Pose2d> places;
};

struct Waypoint {
  double seconds = 0;  // from the plan's begin
  Pose2d pose;
};

// Cells of a robot's size over the map: one is passable if all of it is free.
class PlanningGrid {
 public:
  // `cell`: metres; it becomes a whole number of pixels, at least that size. `occupied_from`:
  // pixels of that value and more are occupied. Throws grove::InvalidArgument.
  PlanningGrid(const Occupancy& map, double cell, int occupied_from = 50);

  const grove::World& world() const { return world_; }
  double cell_size() const { return size_; }
  // Throws grove::InvalidArgument, naming `field`, for what is not on a passable cell.
  grove::Cell cell_at(const Pose2d& pose, const std::string& field) const;
  // The middle of a cell.
  Pose2d middle(grove::Cell cell) const;

 private:
  double size_;
  Pose2d origin_;
  grove::World world_;
};

// Throws grove::InvalidArgument.
grove::Instance instance_of(const PlanningGrid& grid, const std::vector<Errand>& errands);

// Where a robot is at each step. It looks where it goes next; at the end, where it went last.
std::vector<Waypoint> waypoints(const PlanningGrid& grid, const grove::AgentPlan& plan,
                                double seconds_per_step);

}  // namespace grove_ros2
