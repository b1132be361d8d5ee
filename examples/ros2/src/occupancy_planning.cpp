// SPDX-License-Identifier: MIT
#include "occupancy_planning.h"

#include <cmath>

namespace grove_ros2 {
namespace {

// Transforms the position of a pose from the map's frame to the frame of `origin`; does not
// transform the yaw.
Pose2d from_origin(const Pose2d& origin, const Pose2d& pose) {
  const double x = pose.x - origin.x;
  const double y = pose.y - origin.y;
  const double c = std::cos(origin.yaw);
  const double s = std::sin(origin.yaw);
  return {.x = c * x + s * y, .y = c * y - s * x};
}

Pose2d in_frame(const Pose2d& origin, double x, double y) {
  const double c = std::cos(origin.yaw);
  const double s = std::sin(origin.yaw);
  return {.x = origin.x + c * x - s * y, .y = origin.y + s * x + c * y};
}

int pixels_a_cell(const Occupancy& map, double cell) {
  if (!(map.resolution > 0) || map.width < 1 || map.height < 1 ||
      map.data.size() != static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height))
    throw grove::InvalidArgument("/map",
                                 "expected width * height pixels, and a resolution above 0");
  if (!(cell > 0)) throw grove::InvalidArgument("/cell", "expected metres above 0");
  const double pixels = std::ceil(cell / map.resolution - 1e-6);
  if (pixels > map.width || pixels > map.height)
    throw grove::InvalidArgument("/cell", "is larger than the map");
  return pixels < 1 ? 1 : static_cast<int>(pixels);
}

// Returns the grid of cells of `pixels` x `pixels` pixels. The first row of Grove's grid is the top
// row. Pixels that are left over at the upper and right edge belong to no cell.
grove::World world_of(const Occupancy& map, int pixels, int occupied_from) {
  const int width = map.width / pixels;
  const int height = map.height / pixels;
  std::vector<bool> passable(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                             true);
  for (int y = 0; y < height * pixels; ++y)
    for (int x = 0; x < width * pixels; ++x) {
      const int value = map.data[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                                 static_cast<std::size_t>(x)];
      const int row = height - 1 - y / pixels;
      if (value < 0 || value >= occupied_from)
        passable[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x / pixels)] = false;
    }
  return grove::World::grid(width, height, passable);
}

}  // namespace

PlanningGrid::PlanningGrid(const Occupancy& map, double cell, int occupied_from)
    : size_(pixels_a_cell(map, cell) * map.resolution),
      origin_(map.origin),
      world_(world_of(map, pixels_a_cell(map, cell), occupied_from)) {}

grove::Cell PlanningGrid::cell_at(const Pose2d& pose, const std::string& field) const {
  const Pose2d local = from_origin(origin_, pose);
  const double column = std::floor(local.x / size_);
  const double row = std::floor(local.y / size_);
  if (!(column >= 0 && column < world_.width() && row >= 0 && row < world_.height()))
    throw grove::InvalidArgument(field, "is outside the map");
  const grove::Cell cell{.x = static_cast<int>(column),
                         .y = world_.height() - 1 - static_cast<int>(row)};
  if (!world_.passable(cell)) throw grove::InvalidArgument(field, "is on a cell that is not free");
  return cell;
}

Pose2d PlanningGrid::middle(grove::Cell cell) const {
  return in_frame(origin_, (cell.x + 0.5) * size_, (world_.height() - cell.y - 0.5) * size_);
}

grove::Instance instance_of(const PlanningGrid& grid, const std::vector<Errand>& errands) {
  std::vector<grove::Agent> agents;
  std::vector<grove::Task> tasks;
  for (const Errand& errand : errands) {
    const auto cell = [&](std::size_t i) {
      return grid.cell_at(errand.places[i], errand.robot + "/" + std::to_string(i));
    };
    if (errand.places.empty())
      throw grove::InvalidArgument(errand.robot, "has no places; expected where it is, at least");
    const std::size_t last = errand.places.size() - 1;
    const grove::Cell start = cell(0);
    const grove::Cell goal = cell(last);
    agents.push_back({.id = errand.robot, .start = {.place = start}, .goal = goal});
    for (std::size_t i = 1; i < last; ++i)
      tasks.push_back({.id = errand.robot + "/" + std::to_string(i),
                       .place = cell(i),
                       .agents = {errand.robot}});
  }
  return grove::Instance(grid.world(), agents, tasks);
}

std::vector<Waypoint> waypoints(const PlanningGrid& grid, const grove::AgentPlan& plan,
                                double seconds_per_step) {
  std::vector<Waypoint> found;
  for (const grove::Pose& at : plan.path)
    found.push_back({.seconds = seconds_per_step * static_cast<double>(found.size()),
                     .pose = grid.middle(std::get<grove::Cell>(at.place))});
  const auto goes = [&](std::size_t i) { return plan.path[i].place != plan.path[i + 1].place; };
  const auto heading = [&](std::size_t i) {
    return std::atan2(found[i + 1].pose.y - found[i].pose.y, found[i + 1].pose.x - found[i].pose.x);
  };
  double yaw = 0;
  for (std::size_t i = 0; i + 1 < found.size(); ++i)
    if (goes(i)) yaw = heading(i);
  for (std::size_t i = found.size(); i-- > 0;) {
    if (i + 1 < found.size() && goes(i)) yaw = heading(i);
    found[i].pose.yaw = yaw;
  }
  return found;
}

}  // namespace grove_ros2
