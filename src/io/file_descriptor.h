// SPDX-License-Identifier: MIT
// POSIX file descriptors, for operations that streams do not support.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace grove::detail {

// An open file. The destructor closes it.
class FileDescriptor {
 public:
  // Takes ownership of an open descriptor, or of -1.
  explicit FileDescriptor(int fd) : fd_(fd) {}
  // `flags` as in open(2). A new file has permissions 0666 minus the umask. If the file cannot be
  // opened, is_open() is false and errno states the reason.
  FileDescriptor(const std::filesystem::path& path, int flags)
      : FileDescriptor(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }

  bool is_open() const { return fd_ >= 0; }
  int get() const { return fd_; }
  // Some file systems report errors only in close(2). This function closes a duplicate, so that the
  // file stays locked.
  bool reports_no_error() const {
    const int copy = ::fcntl(fd_, F_DUPFD_CLOEXEC, 0);
    return copy >= 0 && ::close(copy) == 0;
  }

 private:
  int fd_;
};

// The host name of this machine.
std::string host_name();

// Writes all of `content`. Returns false and sets errno on failure.
bool write_all(int fd, std::string_view content);

enum class LockResult : std::uint8_t {
  kLocked,
  kHeld,         // by another open file, on this or another host
  kUnsupported,  // by this file system; errno is set
};

// Locks the file, which must be open for writing, against all other processes that use lock(), on
// all hosts that share it (as far as the file system supports this). The kernel releases the lock
// when the last descriptor of this open file is closed, however the process ends. (Uses the open
// file description locks of fcntl(2). On some file systems, locks of flock(2) are not visible on
// other hosts. Traditional fcntl locks are released as soon as the process closes any descriptor of
// the file.)
LockResult lock(int fd);

}  // namespace grove::detail
