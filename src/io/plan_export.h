// SPDX-License-Identifier: MIT
// Writes plans in the file formats of other tools. Each function writes its file atomically, with
// the agents in the order of the instance, and throws InputError if the file cannot be written.
// Precondition: `solution` has a plan of `instance` that is valid by check().
// write_libmrp_schedule(), write_visualizer_text() and write_path_lists() throw NotRepresentable if
// the map is a roadmap, turns of an agent take time, or tasks take time or need only some of their
// agents, because these formats do not state visits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/frame.h"
#include "model/plan.h"

namespace grove::detail {

// Writes a schedule of libMultiRobotPlanning (YAML): x, y and t for every time step until the agent
// rests, where x is the column and y is the row. Agents are named by their ids, because the viewer
// looks up an agent of the instance by its name. Statistics that `solution` does not contain are
// omitted. Also throws NotRepresentable if an id is too long for a YAML key.
void write_libmrp_schedule(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution);

// Writes the text format of mapf-visualizer and of the planners lacam and pibt
// (https://github.com/Kei18/mapf-visualizer): one line per time step with (x,y) of every agent,
// until the last agent rests. For an agent without a destination, the goal in the file is its last
// cell. soc_lb is the proven lower bound. makespan_lb and sum_of_loss_lb are computed from the
// distances between each agent's start and the cells that it must visit. `map` is the file name of
// the map.
void write_visualizer_text(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution, const std::string& map);

// Writes a path list as EECBS, CBSH2-RTC and MAPF-LNS2 do with --outputPaths: one line per agent
// with (row,column) for each time step until the agent rests.
void write_path_lists(const std::filesystem::path& path, const Instance& instance,
                      const Solution& solution);

// Writes the 2024 format of PlanViz, the viewer of the League of Robot Runners
// (https://github.com/MAPF-Competition/PlanViz). Paths are sequences of actions: U, D, L, R, where
// U is one row down; or F, R, C for robots that turn; and W for a wait. Each agent has one task in
// the file, whose errands are the agent's tasks in the order of its visits and then its
// destination; an agent without errands has no task. Throws NotRepresentable if the map is a
// roadmap, if a turn takes more than one step, or if only some robots turn.
void write_planviz(const std::filesystem::path& path, const Instance& instance,
                   const Solution& solution);

// The scale for converting the steps and places of a plan to seconds and metres.
struct Scale {
  Frame frame;
  double seconds_per_step = 1;
};

// Writes timed waypoints (CSV) with the columns robot, seconds, x, y (metres), theta (radians,
// counterclockwise from x) and task. There is a row for each arrival at a place, for each step of a
// turn, and for the start and end of each wait and of each task execution. Between rows robots move
// at constant speed. theta is the heading; for robots that turn freely it is the direction of the
// next move, and after the last move the direction of that move (0 if the robot never moves). task
// is the id of a task that the robot visits or executes at that time.
void write_waypoints(const std::filesystem::path& path, const Instance& instance,
                     const Solution& solution, const Scale& scale);

// Writes the same waypoints for ROS, as YAML with one nav_msgs/Path per robot, under the robot's
// id, in the frame "map".
void write_nav_paths(const std::filesystem::path& path, const Instance& instance,
                     const Solution& solution, const Scale& scale);

}  // namespace grove::detail
