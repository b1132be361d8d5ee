// SPDX-License-Identifier: MIT
// Plans as files for the viewers and archives of other tools. All keep the paths, agents in the
// order of the instance, and none the order of visits. Each function writes a file whole or not at
// all, and throws InputError when it cannot be written. `solution` must hold a valid plan of
// `instance`: ask check() first.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/frame.h"
#include "model/plan.h"

namespace grove::detail {

// libMultiRobotPlanning's schedule (YAML): x, y, t of every step until the agent comes to rest, x
// the column and y the row. Its viewer finds an agent by its name in the instance, so the ids are
// the names. Statistics that the plan file does not tell are left out. Throws NotRepresentable for
// an id that is longer than a key of YAML may be.
void write_libmrp_schedule(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution);

// The text that mapf-visualizer reads, as the planners lacam and pibt write it
// (https://github.com/Kei18/mapf-visualizer): one line per time with (x,y), of every agent until
// the last one comes to rest. An agent without a destination has the cell where it ends as its
// goal. soc_lb is the proven lower bound; makespan_lb and sum_of_loss_lb come from the distances
// from the start to each cell that the agent must be on. `map` is the name of the map file.
void write_visualizer_text(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution, const std::string& map);

// The path lists of EECBS, CBSH2-RTC and MAPF-LNS2 (their --outputPaths): one line per agent with
// (row,column), each until the agent comes to rest.
void write_path_lists(const std::filesystem::path& path, const Instance& instance,
                      const Solution& solution);

// What PlanViz shows, the viewer of the League of Robot Runners
// (https://github.com/MAPF-Competition/ PlanViz), in its format of 2024: paths as actions, U, D, L,
// R (U is one row down there) or, of robots that turn, F, R, C; W is a wait. Each agent has one
// task of several errands: its own tasks in the order of its visits, then its destination. Throws
// NotRepresentable on roadmaps, for turns that do not take one step, and where some robots turn and
// others do not.
void write_planviz(const std::filesystem::path& path, const Instance& instance,
                   const Solution& solution);

// How steps and places of a plan are seconds and metres.
struct Scale {
  Frame frame;
  double seconds_per_step = 1;
};

// Timed waypoints, CSV: robot, seconds, x, y, theta (radians, counterclockwise from x), task. A row
// for each place come to, each step of a turn, and the begin and the end of each wait and of work;
// in between robots move steadily. theta is the heading; of robots that turn freely the direction
// in which they go on, at the end that in which they came. `task` is the one visited, or at work
// on, then.
void write_waypoints(const std::filesystem::path& path, const Instance& instance,
                     const Solution& solution, const Scale& scale);

// The same for ROS: YAML with one nav_msgs/Path for each robot, by its id, in the frame "map".
void write_nav_paths(const std::filesystem::path& path, const Instance& instance,
                     const Solution& solution, const Scale& scale);

}  // namespace grove::detail
