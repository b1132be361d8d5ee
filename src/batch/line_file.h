// SPDX-License-Identifier: MIT
// A file to which whole lines are appended.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "io/file_descriptor.h"

namespace grove::detail::batch {

// The complete lines of `text`, the content of such a file, as views into `text`. An incomplete
// last line is omitted.
std::vector<std::string_view> whole_lines(std::string_view text);

// Appends to a file. If the process is killed, at most the last line is incomplete. One thread at a
// time.
class LineFile {
 public:
  // Creates the file if it is missing. Throws InputError if it cannot be written.
  explicit LineFile(std::filesystem::path path);

  // Appends `lines`, which end in line ends, in one write. Throws InputError if that fails.
  void append(std::string_view lines);
  // Returns when everything appended would survive a system crash. Throws InputError.
  void flush();

 private:
  const std::filesystem::path path_;
  const FileDescriptor file_;
};

}  // namespace grove::detail::batch
