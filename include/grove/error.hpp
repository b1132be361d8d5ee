// SPDX-License-Identifier: MIT
/// \file
/// What the library throws: these, and std::bad_alloc.
#pragma once

#include <stdexcept>
#include <string>

#include "grove/export.hpp"

namespace grove {

/// Everything below; by itself: a part of the search turned out to be broken. what() is one line,
/// fit for a person.
class GROVE_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;   ///< Of its text.
  Error(const Error&) = default;             ///< A copy.
  Error& operator=(const Error&) = default;  ///< Makes it a copy.
  ~Error() override;
};

/// A file, or the text of one, that cannot be used: what() is "FILE: PLACE: what is wrong and what
/// was expected".
class GROVE_API InputError : public Error {
 public:
  using Error::Error;                                  ///< Of its text.
  InputError(const InputError&) = default;             ///< A copy.
  InputError& operator=(const InputError&) = default;  ///< Makes it a copy.
  ~InputError() override;
};

/// A world, instance, plan or option that is against a rule.
class GROVE_API InvalidArgument : public Error {
 public:
  /// what() is both: "/omega: expected a number from 0".
  InvalidArgument(std::string field, const std::string& message);
  InvalidArgument(const InvalidArgument&) = default;             ///< A copy.
  InvalidArgument& operator=(const InvalidArgument&) = default;  ///< Makes it a copy.
  ~InvalidArgument() override;
  /// What is wrong, a JSON Pointer: "/agents/2/goal", "/omega"; empty: the whole.
  const std::string& field() const noexcept { return field_; }

 private:
  std::string field_ = {};
};

}  // namespace grove
