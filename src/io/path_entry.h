// SPDX-License-Identifier: MIT
// Where an agent is, as files say it: [x, y] on a grid, [x, y, "N"] if it turns, and [x, y, "N",
// "E", k] within a turn; ["A"], or ["A", "B", k] k steps from A, on a roadmap (docs/design.md,
// section 1).
#pragma once

#include <nlohmann/json.hpp>

#include "io/json_value.h"
#include "model/instance.h"

namespace grove::detail {

// Throw InputError at `value` if it is none of this map, or not of this motion. (A cell may be
// blocked.)
Pose read_pose(const Map& map, Motion motion, const JsonValue& value);
Heading read_heading(const JsonValue& value);

nlohmann::ordered_json pose_json(const Map& map, Motion motion, const Pose& pose);

// The place of a vertex, which may also be its id alone.
Place read_vertex(const Roadmap& roadmap, const JsonValue& value);
// The same of a start: a vertex is written as its id alone.
Place read_start(const Roadmap& roadmap, const JsonValue& value);

}  // namespace grove::detail
