// SPDX-License-Identifier: MIT
/// \file
/// Exceptions of the library. It also throws std::bad_alloc.
#pragma once

#include <stdexcept>
#include <string>

#include "grove/export.hpp"

namespace grove {

/// Base class of the exceptions below. Thrown itself, it reports an internal error of the search.
/// what() is one line of text for people.
class GROVE_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;   ///< From the text of what().
  Error(const Error&) = default;             ///< Copy constructor.
  Error& operator=(const Error&) = default;  ///< Copy assignment.
  ~Error() override;
};

/// A file, or the text of a file, is invalid or cannot be read or written. what() is "FILE: PLACE:
/// what is wrong; expected WHAT".
class GROVE_API InputError : public Error {
 public:
  using Error::Error;                                  ///< From the text of what().
  InputError(const InputError&) = default;             ///< Copy constructor.
  InputError& operator=(const InputError&) = default;  ///< Copy assignment.
  ~InputError() override;
};

/// An argument (world, instance, plan, change or option) is invalid.
class GROVE_API InvalidArgument : public Error {
 public:
  /// what() is "FIELD: MESSAGE", for example "/omega: expected a number from 0".
  InvalidArgument(std::string field, const std::string& message);
  InvalidArgument(const InvalidArgument&) = default;             ///< Copy constructor.
  InvalidArgument& operator=(const InvalidArgument&) = default;  ///< Copy assignment.
  ~InvalidArgument() override;
  /// JSON Pointer to the invalid value: "/agents/2/goal", "/omega"; empty: the whole argument.
  const std::string& field() const noexcept { return field_; }

 private:
  std::string field_ = {};
};

}  // namespace grove
