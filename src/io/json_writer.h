// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace grove::detail {

// `document`, an object, with one member per line; of arrays and objects directly below it, one
// element per line. Made to be read and compared by people: one agent, one line.
std::string dump_by_lines(const nlohmann::ordered_json& document);

}  // namespace grove::detail
