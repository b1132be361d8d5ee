// SPDX-License-Identifier: MIT
// Converts an occupancy grid and poses in metres to a Grove instance, and a plan to poses with
// times. Does not depend on ROS, so that it can be tested without ROS.
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

// An occupancy grid as in nav_msgs/OccupancyGrid. `data` contains the pixels row by row from the
// bottom, from 0 (free) to 100 (occupied); -1 is unknown.
struct Occupancy {
  int width = 0;
  int height = 0;
  double resolution = 0;  // metres per pixel
  Pose2d origin;          // lower left corner of pixel (0, 0)
  std::vector<std::int8_t> data;
};

// The places of one robot. It starts at the first place, visits the places in between in any order,
// and ends at the last place.
struct Errand {
  std::string robot;
  std::vector<Pose2d> places;
};

struct Waypoint {
  double seconds = 0;  // since the start of the plan
  Pose2d pose;
};

// A grid of robot-sized cells on the map. A cell is passable if all its pixels are free; unknown
// pixels are not.
class PlanningGrid {
 public:
  // `cell`: side of a cell in metres, rounded up to whole pixels. `occupied_from`: pixels with at
  // least this value are occupied. Throws grove::InvalidArgument with field() "/map" or "/cell".
  PlanningGrid(const Occupancy& map, double cell, int occupied_from = 50);

  const grove::World& world() const { return world_; }
  double cell_size() const { return size_; }
  // Returns the cell that contains the pose. Throws grove::InvalidArgument with field() `field` if
  // the pose is not on a passable cell.
  grove::Cell cell_at(const Pose2d& pose, const std::string& field) const;
  // Returns the pose at the centre of a cell.
  Pose2d middle(grove::Cell cell) const;

 private:
  double size_;
  Pose2d origin_;
  grove::World world_;
};

// Returns the instance for these errands. Throws grove::InvalidArgument with field() "ROBOT" or
// "ROBOT/INDEX" for a robot without places and for a place that is not on a passable cell.
grove::Instance instance_of(const PlanningGrid& grid, const std::vector<Errand>& errands);

// Returns the robot's pose at each time step of the plan. The robot faces the direction of its next
// move and, after its last move, the direction of that move. If it never moves, its yaw is 0.
std::vector<Waypoint> waypoints(const PlanningGrid& grid, const grove::AgentPlan& plan,
                                double seconds_per_step);

}  // namespace grove_ros2
