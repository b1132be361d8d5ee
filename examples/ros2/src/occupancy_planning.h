// SPDX-License-Identifier: MIT
// Converts an occupancy grid and poses in metres to a Grove instance, and its plan to poses with
// times. Independent of ROS, so that it can be tested without ROS.
#pragma once

#include <cstdint>
#include <grove/grove.hpp>
#include <string>
#include <vector>

namespace grove_ros2 {

// A pose in the map's frame, in metres and radians.
struct Pose2d {
  double x = 0;
  double y = 0;
  double yaw = 0;
};

// As in nav_msgs/OccupancyGrid: row by row from the bottom; 0: free, 100: occupied, -1: unknown.
struct Occupancy {
  int width = 0;
  int height = 0;
  double resolution = 0;  // metres per pixel
  Pose2d origin;          // the lower left corner of pixel (0, 0)
  std::vector<std::int8_t> data;
};

// Places of one robot: it starts at the first, visits the ones between in any order, and ends at
// the last.
struct Errand {
  std::string robot;
  std::vector<Pose2d> places;
};

struct Waypoint {
  double seconds = 0;  // from the begin of the plan
  Pose2d pose;
};

// A grid of cells of a robot's size on the map. A cell is passable if all its pixels are free.
class PlanningGrid {
 public:
  // `cell`: side of a cell in metres, rounded up to whole pixels. `occupied_from`: pixels of this
  // value or more are occupied. Throws grove::InvalidArgument.
  PlanningGrid(const Occupancy& map, double cell, int occupied_from = 50);

  const grove::World& world() const { return world_; }
  double cell_size() const { return size_; }
  // Throws grove::InvalidArgument with this `field` if the pose is not on a passable cell.
  grove::Cell cell_at(const Pose2d& pose, const std::string& field) const;
  // Returns the pose of the middle of a cell.
  Pose2d middle(grove::Cell cell) const;

 private:
  double size_;
  Pose2d origin_;
  grove::World world_;
};

// Throws grove::InvalidArgument.
grove::Instance instance_of(const PlanningGrid& grid, const std::vector<Errand>& errands);

// Returns the robot's pose at each step. It faces its next move; after its last move, the direction
// of that move.
std::vector<Waypoint> waypoints(const PlanningGrid& grid, const grove::AgentPlan& plan,
                                double seconds_per_step);

}  // namespace grove_ros2
