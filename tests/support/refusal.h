// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "io/input_error.h"

namespace grove::detail {

// Calls `act` and returns the message of the InputError that it throws, without the directory of
// its file. Returns "accepted" if it throws nothing. Other exceptions propagate.
inline std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    const std::string text = error.what();
    const std::size_t file_end = text.find(": ");
    const std::size_t slash = text.rfind('/', file_end);
    return slash == std::string::npos ? text : text.substr(slash + 1);
  }
  return "accepted";
}

}  // namespace grove::detail
