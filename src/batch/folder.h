// SPDX-License-Identifier: MIT
// The folder that a long run writes to.
#pragma once

#include <filesystem>

#include "io/file_descriptor.h"

namespace grove::detail::batch {

// Makes `folder` and those above it where they are missing. Throws InputError when it cannot.
void make_folder(const std::filesystem::path& folder);

// Keeps other processes out of a folder, where the file system has locks, for as long as it lives
// and this process does.
class FolderLock {
 public:
  // `folder` must exist. Throws InputError when it cannot be written to or another has locked it.
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  const FileDescriptor file_;
};

}  // namespace grove::detail::batch
