// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace grove::detail {

// Parses `text`. Throws InputError, naming `file`, if it is not exactly one JSON value, if an
// object repeats a key, or if it is nested deeper than any of Grove's formats requires.
nlohmann::json parse_json(std::string_view text, const std::string& file);

}  // namespace grove::detail
