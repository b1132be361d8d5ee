// SPDX-License-Identifier: MIT
// Reads logs of executions (docs/drive-log.md).
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

// The observed position of a robot at one time.
struct PoseSample {
  double seconds = 0;
  double x = 0;  // cells, y down; or metres of a roadmap, y up
  double y = 0;
  double angle = 0;  // degrees clockwise from north; NaN: unknown
  std::int32_t completed = 0;
  std::uint8_t state = 0;  // index in kDriveStates
};

struct ExecutionLog {
  std::string order;  // name of the file of the action dependency graph
  double seconds_per_step = 1;
  std::vector<std::vector<PoseSample>> robots;  // by agent, in order of time
};

// Reads the complete lines of the log of an execution of `order`. An incomplete last line is
// ignored. Throws InputError.
ExecutionLog read_drive_file(const std::filesystem::path& path, const Instance& instance,
                             const ActionDependencyGraph& order);

}  // namespace grove::detail
