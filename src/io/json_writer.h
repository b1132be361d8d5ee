// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace grove::detail {

// `document`, an object, as text with one member per line. An array or object directly below it has
// one element per line. So people can read and compare it: one agent per line.
std::string dump_by_lines(const nlohmann::ordered_json& document);

}  // namespace grove::detail
