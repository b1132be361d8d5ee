// SPDX-License-Identifier: MIT
// Folders and files that one run at a time may write to.
#pragma once

#include <filesystem>

#include "io/file_descriptor.h"

namespace grove::detail {

// Holds the lock that the file at `path` stands for, until it or the process ends, however that
// comes: the file is left behind, a lock never is. The file says who holds it. A lock counts on all
// hosts that share the file system. Not to be shared by threads.
class FileLock {
 public:
  // Throws InputError when another holds it, and says who; when the file cannot be written; and
  // when it is a link, through which any other file would be written.
  explicit FileLock(const std::filesystem::path& path);

  // False where the file system knows no locks: then nobody is kept away.
  bool is_held() const { return held_; }

 private:
  FileDescriptor file_;
  bool held_ = true;
};

// Keeps other runs from writing the file `output` while it lives: by a lock on a file beside it,
// .grove-NAME.lock, which goes with this. (What a killed run leaves is not locked, and is used
// again.) Special files, as /dev/null, are not locked, nor files in a folder where nothing can be
// written, as writing them will tell. Not to be shared by threads.
class OutputLock {
 public:
  // Throws InputError when another run writes this file, and says which.
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();
  OutputLock(OutputLock&&) = default;
  OutputLock& operator=(OutputLock&&) = delete;

 private:
  std::filesystem::path path_;
  FileDescriptor file_;  // not open: nothing is locked
};

}  // namespace grove::detail
