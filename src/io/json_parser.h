// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace grove::detail {

// Parses `text`. Throws InputError, naming `file`, for anything that is not one JSON value, for a
// key repeated within one object, and for nesting beyond what any of Grove's formats needs.
nlohmann::json parse_json(std::string_view text, const std::string& file);

}  // namespace grove::detail
