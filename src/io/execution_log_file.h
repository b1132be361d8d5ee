// SPDX-License-Identifier: MIT
// Reads execution logs (docs/drive-log.md).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "execution/action_dependency_graph.h"
#include "model/instance.h"

namespace grove::detail {

inline constexpr std::array kDriveStates{"waiting", "moving", "working", "lifted", "lost", "done"};

// The observed pose and state of a robot at one time.
struct PoseSample {
  double seconds = 0;
  double x = 0;  // on a grid in cells, with y downwards; on a roadmap in metres, with y upwards
  double y = 0;
  double angle = 0;            // heading in degrees clockwise from north; NaN: unknown
  std::int32_t completed = 0;  // number of the robot's actions that are completed
  std::uint8_t state = 0;      // index in kDriveStates
};

struct ExecutionLog {
  std::string order;  // name of the file of the action dependency graph
  double seconds_per_step = 1;
  std::vector<std::vector<PoseSample>> robots;  // by AgentIndex: samples in order of time
};

// Reads the log of an execution of `order`. Ignores an incomplete last line. Throws InputError for
// any other invalid content.
ExecutionLog read_drive_file(const std::filesystem::path& path, const Instance& instance,
                             const ActionDependencyGraph& order);

}  // namespace grove::detail
