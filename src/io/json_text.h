// SPDX-License-Identifier: MIT
// JSON as text: parsing and writing.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace grove::detail {

// Parses `text`. Throws InputError, naming `file`, if it is not exactly one JSON value, if an
// object repeats a key, or if it is nested deeper than any of Grove's formats requires.
nlohmann::json parse_json(std::string_view text, const std::string& file);

// `document`, an object, as text with one member per line. An array or object directly below it has
// one element per line. So people can read and compare it: one agent per line.
std::string dump_by_lines(const nlohmann::ordered_json& document);

}  // namespace grove::detail
