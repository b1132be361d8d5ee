// SPDX-License-Identifier: MIT
// Parses and formats JSON text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace grove::detail {

// Parses `text`. Throws InputError, with `file` as the name of the file, if it is not exactly one
// JSON value, if an object repeats a key, or if it is nested more deeply than any Grove format
// requires.
nlohmann::json parse_json(std::string_view text, const std::string& file);

// Returns `document`, which must be an object, as text with one member per line. If a member is an
// array or object, each of its elements has a line of its own, such as one line per agent, so that
// people and diff tools can compare files.
std::string dump_by_lines(const nlohmann::ordered_json& document);

}  // namespace grove::detail
