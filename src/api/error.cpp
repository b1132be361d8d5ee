// SPDX-License-Identifier: MIT
#include "grove/error.hpp"

#include <utility>

#include "grove/version.hpp"

namespace grove {

Error::~Error() = default;
InputError::~InputError() = default;
InvalidArgument::~InvalidArgument() = default;

InvalidArgument::InvalidArgument(std::string field, const std::string& message)
    : Error(field.empty() ? message : field + ": " + message), field_(std::move(field)) {}

const char* version() {
  return GROVE_VERSION;
}

}  // namespace grove
