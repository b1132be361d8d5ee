// SPDX-License-Identifier: MIT
// What the library throws: these, and std::bad_alloc. what() is one line, fit for a person.
#pragma once

#include <stdexcept>
#include <string>

#include "grove/export.hpp"

namespace grove {

// Everything below; by itself: a part of the search turned out to be broken.
class GROVE_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  Error(const Error&) = default;
  Error& operator=(const Error&) = default;
  ~Error() override;
};

// A file, or the text of one, that cannot be used: "FILE: PLACE: what is wrong and what was
// expected".
class GROVE_API InputError : public Error {
 public:
  using Error::Error;
  InputError(const InputError&) = default;
  InputError& operator=(const InputError&) = default;
  ~InputError() override;
};

// A world, instance, plan or option that is against a rule. field() is what is wrong, as a JSON
// path:
// "/agents/2/goal", "/omega".
class GROVE_API InvalidArgument : public Error {
 public:
  InvalidArgument(std::string field, const std::string& message);
  InvalidArgument(const InvalidArgument&) = default;
  InvalidArgument& operator=(const InvalidArgument&) = default;
  ~InvalidArgument() override;
  const std::string& field() const noexcept { return field_; }

 private:
  std::string field_ = {};
};

}  // namespace grove
