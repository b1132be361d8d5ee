// SPDX-License-Identifier: MIT
#include "tests/oracle/steps.h"

#include <algorithm>
#include <variant>

namespace grove::detail::oracle {
namespace {

std::vector<std::vector<Place>> steps(const Grid& grid) {
  std::vector<std::vector<Place>> steps(static_cast<std::size_t>(grid.cell_count()));
  const auto is_open = [&](Position p) { return grid.contains(p) && grid.passable(grid.cell(p)); };
  for (int y = 0; y < grid.height(); ++y)
    for (int x = 0; x < grid.width(); ++x)
      for (const Position to :
           {Position{x - 1, y}, Position{x + 1, y}, Position{x, y - 1}, Position{x, y + 1}})
        if (is_open({x, y}) && is_open(to)) steps[grid.cell({x, y})].push_back(grid.cell(to));
  return steps;
}

std::vector<std::vector<Place>> steps(const Roadmap& roadmap) {
  std::vector<std::vector<Place>> steps(static_cast<std::size_t>(roadmap.place_count()));
  const auto add = [&](Place from, Place to) {
    if (from != to && std::ranges::count(steps[from], to) == 0) steps[from].push_back(to);
  };
  for (std::size_t r = 0; r < roadmap.roads().size(); ++r) {
    const Road& road = roadmap.roads()[r];
    std::vector<Place> along{road.from};
    for (Time k = 1; k < road.steps; ++k)
      along.push_back(roadmap.place_on_road(static_cast<int>(r), k));
    along.push_back(road.to);
    for (std::size_t i = 1; i < along.size(); ++i) {
      add(along[i - 1], along[i]);
      if (!road.one_way) add(along[i], along[i - 1]);
    }
  }
  return steps;
}

}  // namespace

std::vector<std::vector<Place>> steps_on(const Map& map) {
  return std::visit([](const auto& m) { return steps(m); }, map);
}

std::vector<Pose> next_poses(const Instance& instance, const Agent& agent,
                             const std::vector<std::vector<Place>>& steps, const Pose& pose) {
  std::vector<Pose> poses;
  const Time turn_steps = agent.motion.turn_steps;
  if (turn_steps == 0) {
    for (const Place place : steps[pose.place]) poses.push_back({.place = place});
    return poses;
  }
  const auto turn_on = [&](Heading to, Time made) {
    if (made < turn_steps)
      poses.push_back({pose.place, pose.heading, to, made});
    else
      poses.push_back({pose.place, to, to, 0});
  };
  if (pose.steps > 0) {
    turn_on(pose.to, pose.steps + 1);
    return poses;
  }
  const Position here = instance.grid().position(pose.place);
  for (const Place place : steps[pose.place]) {
    const Position there = instance.grid().position(place);
    const Heading way = there.y < here.y   ? Heading::kNorth
                        : there.y > here.y ? Heading::kSouth
                        : there.x > here.x ? Heading::kEast
                                           : Heading::kWest;
    if (way == pose.heading) poses.push_back({place, way, way, 0});
  }
  for (const int quarters : {1, 3})
    turn_on(static_cast<Heading>((static_cast<int>(pose.heading) + quarters) % 4), 1);
  return poses;
}

}  // namespace grove::detail::oracle
