// SPDX-License-Identifier: MIT
#include "batch/folder.h"

#include <fcntl.h>

#include <system_error>

#include "io/input_error.h"

namespace grove::detail::batch {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "", "cannot be made: " + error.message());
}

// Locks a separate file, because other files in the folder are replaced.
FolderLock::FolderLock(const std::filesystem::path& folder)
    : file_(folder / ".lock", O_RDWR | O_CREAT | O_NOFOLLOW) {
  if (!file_.is_open()) fail_to_write(folder / ".lock");
  if (lock(file_.get()) == LockResult::kHeld)
    throw InputError(folder.string(), "",
                     "is in use by another run; expected a folder that no other run writes to");
}

}  // namespace grove::detail::batch
