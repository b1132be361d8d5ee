// SPDX-License-Identifier: MIT
// The one exception for bad input.
#pragma once

#include <stdexcept>
#include <string>

namespace grove {

// A file that cannot be used: unreadable, malformed, or in conflict with another one. what() is one
// line fit for a person: "FILE: PLACE: what is wrong and what was expected". The place is a line
// and column ("line 7, column 12") or a JSON path ("/agents/3/start"); empty when it is the whole
// file.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, const std::string& place, const std::string& message)
      : std::runtime_error(place.empty() ? file + ": " + message
                                         : file + ": " + place + ": " + message) {}
};

}  // namespace grove
