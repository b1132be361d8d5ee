// SPDX-License-Identifier: MIT
// POSIX file descriptors and locks, for operations that C++ streams do not support.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace grove::detail {

// Owns a file descriptor, which the destructor closes.
class FileDescriptor {
 public:
  // Takes ownership of an open descriptor, or of -1.
  explicit FileDescriptor(int fd) : fd_(fd) {}
  // Opens `path`. `flags` as for open(2). A new file has permissions 0666 without the bits of the
  // umask. If the file cannot be opened, is_open() is false and errno is set.
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
  // Closes a duplicate of the descriptor, and returns true if this reports no error. Some file
  // systems report write errors only in close(2). The descriptor itself remains open, and the file
  // locked.
  bool reports_no_error() const {
    const int copy = ::fcntl(fd_, F_DUPFD_CLOEXEC, 0);
    return copy >= 0 && ::close(copy) == 0;
  }

 private:
  int fd_;
};

// The host name of this machine.
std::string host_name();

// Writes `content` completely. Returns false and sets errno on failure.
bool write_all(int fd, std::string_view content);

enum class LockResult : std::uint8_t {
  kLocked,
  kHeld,         // another open file holds the lock, on this or another host
  kUnsupported,  // locking failed, usually because the file system has no locks; errno is set
};

// Locks the file, which must be open for writing, against all other callers of lock(), on all hosts
// that share the file (as far as the file system supports this). Does not wait. The kernel releases
// the lock when the last descriptor of this open file is closed, even if the process is killed.
// (Uses the open file description locks of fcntl(2), because on some file systems locks of flock(2)
// are not visible on other hosts, and traditional locks of fcntl(2) are released as soon as the
// process closes any descriptor of the file.)
LockResult lock(int fd);

}  // namespace grove::detail
