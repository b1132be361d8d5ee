// SPDX-License-Identifier: MIT
#include "io/file_lock.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <functional>
#include <string>
#include <system_error>
#include <utility>

#include "io/atomic_file.h"
#include "io/input_error.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxHolderLength = 400;

std::string description_of_this_process() {
  return fmt::format("process {} on host {}, since {:%F %T} UTC", ::getpid(), host_name(),
                     fmt::gmtime(std::time(nullptr)));
}

std::string holder(const FileDescriptor& file) {
  char text[kMaxHolderLength];
  const ssize_t size = ::pread(file.get(), text, sizeof text, 0);
  return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : "it has just started";
}

// Does not follow links, because in a folder where other users may write, a link could lead to any
// file of this user.
FileDescriptor open_lock_file(const fs::path& path) {
  FileDescriptor file(path, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK);
  if (!file.is_open() && errno != ELOOP) return file;
  struct stat status {};
  const bool is_known = file.is_open() && ::fstat(file.get(), &status) == 0;
  if (!is_known || !S_ISREG(status.st_mode) || status.st_nlink > 1)
    throw InputError(path.string(), "", "is a link or not a regular file; expected a lock file");
  return file;
}

bool write_holder(const FileDescriptor& file) {
  return ::ftruncate(file.get(), 0) == 0 && write_all(file.get(), description_of_this_process());
}

// Returns the path of the lock file, for example ".grove-plan.json.lock" for "plan.json". A long
// name is replaced by its hash.
fs::path lock_file_of(const fs::path& output) {
  constexpr std::size_t kMaxNameLength = 200;  // file systems allow 255 bytes
  std::string name = output.filename().string();
  if (name.size() > kMaxNameLength) name = fmt::format("{:016x}", std::hash<std::string>()(name));
  return output.parent_path() / fmt::format(".grove-{}.lock", name);
}

bool is_still_there(const FileDescriptor& file, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file.get(), &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

FileLock::FileLock(const fs::path& path) : file_(open_lock_file(path)) {
  if (!file_.is_open()) fail_to_write(path);
  const LockResult result = lock(file_.get());
  if (result == LockResult::kHeld)
    throw InputError(path.string(), "",
                     fmt::format("is locked by another run ({}); expected that run to end first",
                                 holder(file_)));
  held_ = result == LockResult::kLocked;
  if (!write_holder(file_)) fail_to_write(path);
}

OutputLock::OutputLock(const fs::path& output) : file_(-1) {
  if (is_special_file(output)) return;
  std::error_code error;
  path_ = lock_file_of(fs::weakly_canonical(fs::absolute(output, error), error));
  do {
    file_ = open_lock_file(path_);
    if (!file_.is_open()) return;
    if (lock(file_.get()) == LockResult::kHeld)
      throw InputError(
          output.string(), "",
          fmt::format(
              "is being written by another run ({}); expected another name, or the end of that run",
              holder(file_)));
  } while (!is_still_there(file_, path_));  // else another run has just removed it
  (void)write_holder(file_);                // a failure is ignored: the holder is only for messages
}

OutputLock::~OutputLock() {
  if (file_.is_open()) ::unlink(path_.c_str());
}

}  // namespace grove::detail
