// SPDX-License-Identifier: MIT
// Files as the system knows them, where streams do not do.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace grove::detail {

// An open file; closes itself.
class FileDescriptor {
 public:
  // Takes over one that is open, or -1.
  explicit FileDescriptor(int fd) : fd_(fd) {}
  // `flags` as those of open(2); a file that is made can be read and written by all, but for the
  // umask. errno says why if it is not open then.
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
  // Some file systems report what went wrong only when a file is closed. Here a copy is, for the
  // lock is to stay.
  bool reports_no_error() const {
    const int copy = ::fcntl(fd_, F_DUPFD_CLOEXEC, 0);
    return copy >= 0 && ::close(copy) == 0;
  }

 private:
  int fd_;
};

// What this machine calls itself.
std::string host_name();

// All of `content`, or false and errno.
bool write_all(int fd, std::string_view content);

enum class LockResult : std::uint8_t {
  kLocked,
  kHeld,         // by another open file, here or on another host
  kUnsupported,  // by this file system; errno says how
};

// Locks the file, open for writing, against everybody else who asks, on all hosts that share it (as
// far as the file system goes). The kernel gives the lock back when the last descriptor of this
// open file is closed, in whatever way its process ends. (fcntl's locks of open files: those of
// flock() do not leave the host on every file system, and fcntl's other ones are given back as soon
// as the process closes the file under any descriptor.)
LockResult lock(int fd);

}  // namespace grove::detail
