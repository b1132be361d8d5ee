// SPDX-License-Identifier: MIT
/// \file
/// Exceptions that the library throws, in addition to std::bad_alloc, and to std::out_of_range from
/// Plan::pose().
#pragma once

#include <stdexcept>
#include <string>

#include "grove/export.hpp"

namespace grove {

/// Base class of the exceptions below. An exception of exactly this type reports an internal error
/// of the search or, from grove::mpi, a failure of MPI or of other ranks. what() is a one-line
/// message for people.
class GROVE_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;   ///< From the text of what().
  Error(const Error&) = default;             ///< Copy constructor.
  Error& operator=(const Error&) = default;  ///< Copy assignment.
  ~Error() override;
};

/// Thrown if a file, or the text of a file, is invalid or cannot be read or written. what() is
/// "FILE: PLACE: what is wrong; expected WHAT"; PLACE and the expectation can be absent.
class GROVE_API InputError : public Error {
 public:
  using Error::Error;                                  ///< From the text of what().
  InputError(const InputError&) = default;             ///< Copy constructor.
  InputError& operator=(const InputError&) = default;  ///< Copy assignment.
  ~InputError() override;
};

/// Thrown if an argument (world, instance, plan, change or option) is invalid.
class GROVE_API InvalidArgument : public Error {
 public:
  /// Constructs an exception whose what() is "FIELD: MESSAGE", for example "/threads: found 0;
  /// expected from 1 to 1024", or only MESSAGE if `field` is empty.
  InvalidArgument(std::string field, const std::string& message);
  InvalidArgument(const InvalidArgument&) = default;             ///< Copy constructor.
  InvalidArgument& operator=(const InvalidArgument&) = default;  ///< Copy assignment.
  ~InvalidArgument() override;
  /// JSON Pointer to the invalid value ("/agents/2/goal", "/omega"). Empty: the error concerns no
  /// single value.
  const std::string& field() const noexcept { return field_; }

 private:
  std::string field_ = {};
};

}  // namespace grove
