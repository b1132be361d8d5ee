// SPDX-License-Identifier: MIT
// Logs of drives as files (docs/drive-log.md).
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

// What was seen of a robot at a moment.
struct PoseSample {
  double seconds = 0;
  double x = 0;  // cells, y down; or metres of a roadmap, y up
  double y = 0;
  double angle = 0;  // degrees clockwise from north; NaN: not known
  std::int32_t completed = 0;
  std::uint8_t state = 0;  // of kDriveStates
};

struct ExecutionLog {
  std::string order;  // name of the passing order's file
  double seconds_per_step = 1;
  std::vector<std::vector<PoseSample>> robots;  // by agent, in the order of time
};

// The whole lines of the log of a drive along `order`; a last line that has not ended is left out.
// Throws InputError.
ExecutionLog read_drive_file(const std::filesystem::path& path, const Instance& instance,
                             const ActionDependencyGraph& order);

}  // namespace grove::detail
