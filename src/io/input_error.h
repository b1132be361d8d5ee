// SPDX-License-Identifier: MIT
// InputError, the exception for invalid input and for files that cannot be read or written.
#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace grove::detail {

// Thrown if a file cannot be read or written, is malformed, or contradicts another file. what() is
// one line for the user: "FILE: PLACE: what is wrong and what was expected". PLACE is a line,
// usually with a column ("line 7, column 12"), or a JSON Pointer ("/agents/3/start"); it is omitted
// if the message is about the whole file.
class InputError : public std::runtime_error {
 public:
  InputError(std::string_view file, std::string_view place, std::string_view message);
};

// Thrown if a Grove file is of a different kind from the one expected: "found a plan; expected an
// instance".
class WrongFileKind : public InputError {
 public:
  WrongFileKind(std::string_view file, std::string_view found, std::string_view expected);
  const std::string& found() const { return found_; }

 private:
  std::string found_;
};

// Throw InputError with the system's message for `error`, a value of errno, because the file could
// not be read or written.
[[noreturn]] void fail_to_read(const std::filesystem::path& path, int error = errno);
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error = errno);

// Returns `text` as one printable line, for messages that quote files. Control characters and
// invalid UTF-8 are escaped as \n, \t, \x1b, ... Long text is cut after some hundred bytes.
std::string one_line(std::string_view text);

}  // namespace grove::detail
