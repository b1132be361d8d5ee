// SPDX-License-Identifier: MIT
// The one exception for bad input.
#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace grove::detail {

// A file that cannot be used: unreadable, malformed, or in conflict with another one. what() is one
// line fit for a person: "FILE: PLACE: what is wrong and what was expected". The place is a line
// and column ("line 7, column 12") or a JSON path ("/agents/3/start"); empty when it is the whole
// file.
class InputError : public std::runtime_error {
 public:
  InputError(std::string_view file, std::string_view place, std::string_view message);
};

// A file of Grove, but of another kind than is read here: "found a plan; expected an instance".
class WrongFileKind : public InputError {
 public:
  WrongFileKind(std::string_view file, std::string_view found, std::string_view expected);
  const std::string& found() const { return found_; }

 private:
  std::string found_;
};

// The system refuses to read or write the file, as `error` of errno.h says.
[[noreturn]] void fail_to_read(const std::filesystem::path& path, int error = errno);
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error = errno);

// `text` as one printable line, whatever was in it: control characters and broken UTF-8 are written
// as \n, \t, \x1b, ..., and what goes beyond some hundred bytes is cut off. For messages that quote
// files.
std::string one_line(std::string_view text);

}  // namespace grove::detail
