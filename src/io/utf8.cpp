// SPDX-License-Identifier: MIT
#include "io/utf8.h"

#include <nlohmann/json.hpp>

namespace grove::detail {

bool is_utf8(const std::string& text) {
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace grove::detail
