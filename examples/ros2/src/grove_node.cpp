// SPDX-License-Identifier: MIT
// A ROS 2 node that plans for many robots on one map. Its inputs are the map and, for each robot,
// the poses that the robot must visit. Its output is a path with times for each robot. Once all
// inputs have arrived, the node plans, and it re-plans after each further input.
#include <chrono>
#include <cmath>
#include <geometry_msgs/msg/pose_array.hpp>
#include <map>
#include <memory>
#include <nav_msgs/msg/occupancy_grid.hpp>
#include <nav_msgs/msg/path.hpp>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

#include "occupancy_planning.h"

namespace grove_ros2 {
namespace {

using geometry_msgs::msg::Pose;
using geometry_msgs::msg::PoseArray;
using nav_msgs::msg::OccupancyGrid;
using nav_msgs::msg::Path;

Pose2d flat(const Pose& pose) {
  const auto& q = pose.orientation;
  return {.x = pose.position.x,
          .y = pose.position.y,
          .yaw = std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))};
}

Pose message(const Pose2d& pose) {
  Pose result;
  result.position.x = pose.x;
  result.position.y = pose.y;
  result.orientation.z = std::sin(pose.yaw / 2);
  result.orientation.w = std::cos(pose.yaw / 2);
  return result;
}

class GroveNode : public rclcpp::Node {
 public:
  GroveNode()
      : Node("grove"),
        cell_(declare_parameter("cell", 0.5)),
        seconds_per_step_(declare_parameter("seconds_per_step", 1.0)),
        omega_(declare_parameter("omega", 0.05)),
        time_limit_(declare_parameter("time_limit", 1.0)),
        robots_(declare_parameter("robots", std::vector<std::string>())) {
    // The map server publishes the map once. With transient_local, later subscribers receive it
    // too.
    const auto kept = rclcpp::QoS(1).transient_local();
    map_in_ = create_subscription<OccupancyGrid>(
        "map", kept, [this](OccupancyGrid::ConstSharedPtr map) { take_map(*map); });
    for (const std::string& robot : robots_) {
      visits_in_.push_back(create_subscription<PoseArray>(
          robot + "/visits", 10,
          [this, robot](PoseArray::ConstSharedPtr visits) { take_visits(robot, *visits); }));
      paths_out_[robot] = create_publisher<Path>(robot + "/path", kept);
    }
  }

 private:
  void take_map(const OccupancyGrid& map) {
    frame_ = map.header.frame_id;
    grid_.reset();
    try {
      grid_.emplace(Occupancy{.width = static_cast<int>(map.info.width),
                              .height = static_cast<int>(map.info.height),
                              .resolution = map.info.resolution,
                              .origin = flat(map.info.origin),
                              .data = map.data},
                    cell_);
    } catch (const grove::Error& error) {
      RCLCPP_ERROR(get_logger(), "cannot use this map: %s", error.what());
    }
    plan();
  }

  void take_visits(const std::string& robot, const PoseArray& visits) {
    visits_[robot] = visits;
    plan();
  }

  // Returns the errands of all robots. Throws grove::InvalidArgument for poses in a wrong frame.
  std::vector<Errand> errands() const {
    std::vector<Errand> found;
    for (const std::string& robot : robots_) {
      const PoseArray& visits = visits_.at(robot);
      if (visits.header.frame_id != frame_)
        throw grove::InvalidArgument(
            robot + "/visits",
            "is in frame '" + visits.header.frame_id + "'; expected the map's, '" + frame_ + "'");
      found.push_back({.robot = robot, .places = {}});
      for (const Pose& pose : visits.poses) found.back().places.push_back(flat(pose));
    }
    return found;
  }

  void plan() {
    if (!grid_ || visits_.size() < robots_.size()) return;
    try {
      const grove::Solution solution = grove::solve(instance_of(*grid_, errands()),
                                                    {.omega = omega_, .time_limit = time_limit_});
      if (!solution.plan) {
        RCLCPP_ERROR(get_logger(), "no plan: %s", std::string(to_string(solution.status)).c_str());
        return;
      }
      RCLCPP_INFO(get_logger(), "cost %ld, lower bound %ld", static_cast<long>(solution.plan->cost),
                  static_cast<long>(solution.lower_bound));
      publish(*solution.plan);
    } catch (const grove::Error& error) {
      RCLCPP_ERROR(get_logger(), "no plan: %s", error.what());
    }
  }

  void publish(const grove::Plan& plan) {
    const rclcpp::Time begin = now();
    for (const grove::AgentPlan& agent : plan.agents) {
      Path path;
      path.header.frame_id = frame_;
      path.header.stamp = begin;
      for (const Waypoint& waypoint : waypoints(*grid_, agent, seconds_per_step_)) {
        path.poses.emplace_back();
        path.poses.back().header.frame_id = frame_;
        path.poses.back().header.stamp =
            begin + rclcpp::Duration(std::chrono::duration_cast<std::chrono::nanoseconds>(
                        std::chrono::duration<double>(waypoint.seconds)));
        path.poses.back().pose = message(waypoint.pose);
      }
      paths_out_.at(agent.id)->publish(path);
    }
  }

  const double cell_;
  const double seconds_per_step_;
  const double omega_;
  const double time_limit_;
  const std::vector<std::string> robots_;

  std::string frame_;
  std::optional<PlanningGrid> grid_;
  std::map<std::string, PoseArray> visits_;  // by robot; only for robots whose poses have arrived
  rclcpp::Subscription<OccupancyGrid>::SharedPtr map_in_;
  std::vector<rclcpp::Subscription<PoseArray>::SharedPtr> visits_in_;
  std::map<std::string, rclcpp::Publisher<Path>::SharedPtr> paths_out_;
};

}  // namespace
}  // namespace grove_ros2

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<grove_ros2::GroveNode>());
  rclcpp::shutdown();
}
