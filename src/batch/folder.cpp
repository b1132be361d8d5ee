// SPDX-License-Identifier: MIT
#include "grove/batch/folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "grove/io/input_error.h"

namespace grove::batch {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "", "cannot be made: " + error.message());
}

// Held while the descriptor is open. A file of its own: others in the folder are replaced.
FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / ".lock";
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (fd_ < 0)
    throw InputError(path.string(), "",
                     "cannot be written: " + std::generic_category().message(errno));
  if (::flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;  // or has no locks
  ::close(fd_);
  throw InputError(folder.string(), "",
                   "is in use by another run; expected a folder that no other run writes to");
}

FolderLock::~FolderLock() {
  ::close(fd_);
}

}  // namespace grove::batch
