// SPDX-License-Identifier: MIT
// The output folder of a long run.
#pragma once

#include <filesystem>

#include "io/file_descriptor.h"

namespace grove::detail::batch {

// Creates `folder` and its missing parents. Throws InputError if it cannot.
void make_folder(const std::filesystem::path& folder);

// Locks a folder against other processes, if the file system supports locks. The lock ends with
// this object or with the process.
class FolderLock {
 public:
  // `folder` must exist. Throws InputError if the folder is not writable or another process has
  // locked it.
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  const FileDescriptor file_;
};

}  // namespace grove::detail::batch
