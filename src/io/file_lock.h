// SPDX-License-Identifier: MIT
// Locks of folders and output files, so that only one run at a time writes to them.
#pragma once

#include <filesystem>

#include "io/file_descriptor.h"

namespace grove::detail {

// Holds the lock of the file at `path` until this object is destroyed or the process ends, for
// whatever reason. The file stays; the lock does not. The file names the holder. The lock is valid
// on all hosts that share the file system. One thread at a time.
class FileLock {
 public:
  // Throws InputError if another process holds the lock (the message names it), if the file cannot
  // be written, or if it is a link, because writing through it could change any other file.
  explicit FileLock(const std::filesystem::path& path);

  // False if the file system does not support locks. Then other processes are not excluded.
  bool is_held() const { return held_; }

 private:
  FileDescriptor file_;
  bool held_ = true;
};

// While this object exists, other runs cannot write the file `output`. It locks the file
// .grove-NAME.lock in the same folder, and removes that file in the end. (The lock file of a killed
// run is not locked, and is reused.) Does not lock special files such as /dev/null, and files in a
// folder that is not writable, because writing them will fail anyway. One thread at a time.
class OutputLock {
 public:
  // Throws InputError if another run writes this file; the message names the run.
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();
  OutputLock(OutputLock&&) = default;
  OutputLock& operator=(OutputLock&&) = delete;

 private:
  std::filesystem::path path_;
  FileDescriptor file_;  // not open: no lock
};

}  // namespace grove::detail
