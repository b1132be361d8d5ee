// SPDX-License-Identifier: MIT
// Position of an agent in files: [x, y] on a grid; [x, y, "N"] if the agent turns, and [x, y, "N",
// "E", k] within a turn; ["A"] on a roadmap, or ["A", "B", k] k steps from A (docs/design.md,
// section 1).
#pragma once

#include <nlohmann/json.hpp>

#include "io/json_value.h"
#include "model/instance.h"

namespace grove::detail {

// The read functions throw InputError at `value` if it is not a position on this map, or not valid
// for this motion. (The cell may be blocked.)
Pose read_pose(const Map& map, Motion motion, const JsonValue& value);
Heading read_heading(const JsonValue& value);

nlohmann::ordered_json pose_json(const Map& map, Motion motion, const Pose& pose);

// The place of a vertex. The entry may also be the id only.
Place read_vertex(const Roadmap& roadmap, const JsonValue& value);
// The same for a start, where a vertex is written as its id only.
Place read_start(const Roadmap& roadmap, const JsonValue& value);

}  // namespace grove::detail
