// SPDX-License-Identifier: MIT
// Locks on folders and output files, so that only one run at a time writes to them.
#pragma once

#include <filesystem>

#include "io/file_descriptor.h"

namespace grove::detail {

// Holds a lock on the file at `path` until this object is destroyed or the process ends, for
// whatever reason. Creates the file if necessary, writes the holder into it, and does not remove
// it. The lock is effective on all hosts that share the file system. One thread at a time.
class FileLock {
 public:
  // Throws InputError if the lock is held already (the message names the process that holds it), if
  // the file cannot be written, or if it is a link or not a regular file. (A link could lead to any
  // other file.)
  explicit FileLock(const std::filesystem::path& path);

  // False if the file system does not support locks. In this case other processes are not excluded.
  bool is_held() const { return held_; }

 private:
  FileDescriptor file_;
  bool held_ = true;
};

// Prevents other runs from writing the file `output` while this object exists, if the file system
// supports locks. Locks the file .grove-NAME.lock in the same folder, and removes it in the
// destructor. (If a run is killed, its lock file remains without a lock, and the next run reuses
// it.) Does not lock special files such as /dev/null. Also does not lock a file in a folder that is
// not writable, because writing that file will fail anyway. One thread at a time.
class OutputLock {
 public:
  // Throws InputError if another run holds the lock (the message names that run), or if the lock
  // file is a link or not a regular file.
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();
  OutputLock(OutputLock&&) = default;
  OutputLock& operator=(OutputLock&&) = delete;

 private:
  std::filesystem::path path_;
  FileDescriptor file_;  // is_open() is false: not locked
};

}  // namespace grove::detail
