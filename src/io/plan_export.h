// SPDX-License-Identifier: MIT
// Writes plans as files for the viewers and archives of other tools. All formats contain the paths,
// with the agents in the order of the instance. None contains the order of visits. Each function
// writes its file atomically, and throws InputError if the file cannot be written. Precondition:
// `solution` has a plan of `instance` that is valid by check().
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/frame.h"
#include "model/plan.h"

namespace grove::detail {

// The schedule of libMultiRobotPlanning (YAML): x, y, t for every step until the agent rests, where
// x is the column and y the row. Its viewer finds an agent by its name in the instance, so the ids
// are the names. Statistics that the plan file does not contain are omitted. Throws
// NotRepresentable for an id that is longer than a YAML key may be.
void write_libmrp_schedule(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution);

// The text format of mapf-visualizer and of the planners lacam and pibt
// (https://github.com/Kei18/mapf-visualizer): one line per time step with (x,y) of every agent,
// until the last agent rests. The goal of an agent without a destination is its last cell. soc_lb
// is the proven lower bound. makespan_lb and sum_of_loss_lb are computed from the distances from
// the start to each cell that the agent must visit. `map` is the file name of the map.
void write_visualizer_text(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution, const std::string& map);

// The path lists of EECBS, CBSH2-RTC and MAPF-LNS2 (their --outputPaths): one line per agent with
// (row,column) for each time step until the agent rests.
void write_path_lists(const std::filesystem::path& path, const Instance& instance,
                      const Solution& solution);

// The format of PlanViz in 2024, the viewer of the League of Robot Runners
// (https://github.com/MAPF-Competition/PlanViz). Paths are actions: U, D, L, R, where U is one row
// down, or F, R, C for robots that turn; W is a wait. Each agent has one task with several errands:
// its own tasks in the order of its visits, then its destination. Throws NotRepresentable on
// roadmaps, for turns that take more than one step, and if only some robots turn.
void write_planviz(const std::filesystem::path& path, const Instance& instance,
                   const Solution& solution);

// Converts steps and places of a plan to seconds and metres.
struct Scale {
  Frame frame;
  double seconds_per_step = 1;
};

// Timed waypoints (CSV): robot, seconds, x, y, theta (radians, counterclockwise from x), task.
// There is a row for each arrival at a place, for each step of a turn, and for the begin and end of
// each wait and of work. Between these rows robots move at constant speed. theta is the heading.
// For robots that turn freely it is the direction of their next move, and at the end that of their
// last one. `task` is the task that the robot visits or works on at that time.
void write_waypoints(const std::filesystem::path& path, const Instance& instance,
                     const Solution& solution, const Scale& scale);

// The same for ROS: YAML with one nav_msgs/Path per robot, under its id, in the frame "map".
void write_nav_paths(const std::filesystem::path& path, const Instance& instance,
                     const Solution& solution, const Scale& scale);

}  // namespace grove::detail
