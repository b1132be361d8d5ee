// SPDX-License-Identifier: MIT
// A file that grows by whole lines.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "io/file_descriptor.h"

namespace grove::detail::batch {

// The lines that `text`, the content of such a file, holds whole; what follows the last line end is
// torn. They point into `text`.
std::vector<std::string_view> whole_lines(std::string_view text);

// Appends to a file. A process that is killed leaves at most the last line torn. Of one thread.
class LineFile {
 public:
  // Makes the file if it is missing. Throws InputError when it cannot be written.
  explicit LineFile(std::filesystem::path path);

  // Writes `lines`, each with its end, at once. Throws InputError when that fails.
  void append(std::string_view lines);
  // Returns when all that was appended would survive a crash of the machine. Throws InputError.
  void flush();

 private:
  const std::filesystem::path path_;
  const FileDescriptor file_;
};

}  // namespace grove::detail::batch
