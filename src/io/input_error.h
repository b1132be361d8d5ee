// SPDX-License-Identifier: MIT
// The exception for invalid input.
#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace grove::detail {

// A file that cannot be used: it is unreadable, malformed, or contradicts another file. what() is
// one line for the user: "FILE: PLACE: what is wrong and what was expected". PLACE is a line and
// column ("line 7, column 12") or a JSON Pointer ("/agents/3/start"); empty for the whole file.
class InputError : public std::runtime_error {
 public:
  InputError(std::string_view file, std::string_view place, std::string_view message);
};

// A file of Grove of another kind than expected: "found a plan; expected an instance".
class WrongFileKind : public InputError {
 public:
  WrongFileKind(std::string_view file, std::string_view found, std::string_view expected);
  const std::string& found() const { return found_; }

 private:
  std::string found_;
};

// Throws InputError: the system cannot read or write the file; `error` is a value of errno.
[[noreturn]] void fail_to_read(const std::filesystem::path& path, int error = errno);
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error = errno);

// `text` as one printable line, for messages that quote files. Control characters and invalid UTF-8
// are written as \n, \t, \x1b, ... The line is cut after some hundred bytes.
std::string one_line(std::string_view text);

}  // namespace grove::detail
