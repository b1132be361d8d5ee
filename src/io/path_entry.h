// SPDX-License-Identifier: MIT
// Where an agent is, as files say it: [x, y] on a grid; ["A"], or ["A", "B", k] k steps from A, on
// a roadmap (docs/design.md, section 1).
#pragma once

#include <nlohmann/json.hpp>

#include "grove/model/instance.h"
#include "json_value.h"

namespace grove {

// Throws InputError at `value` if it is none of this map. (A cell may be blocked.)
State read_path_entry(const Map& map, const JsonValue& value);
nlohmann::ordered_json path_entry_json(const Map& map, State state);

// The same of a vertex, which may also be its id alone.
Place read_vertex(const Roadmap& roadmap, const JsonValue& value);
// The same of a start: a vertex is written as its id alone.
State read_start(const Roadmap& roadmap, const JsonValue& value);

}  // namespace grove
