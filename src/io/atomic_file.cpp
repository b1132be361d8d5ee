// SPDX-License-Identifier: MIT
#include "io/atomic_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "io/file_descriptor.h"
#include "io/input_error.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporary = ".grove-";
constexpr auto kMaxPause = std::chrono::hours(1);  // between two writes to a file

// Returns the path of the file to write, which is `path` with symbolic links resolved unless it is
// a special file. Sets `status` to the status of this file. Throws InputError if the path names a
// directory or a file without write permission.
fs::path resolved(const fs::path& path, fs::file_status& status) {
  std::error_code error;
  status = fs::status(path, error);
  if (status.type() == fs::file_type::none) fail_to_write(path, error.value());
  if (path.filename().empty() || fs::is_directory(status))
    throw InputError(path.string(), "", "is a directory; expected a file name");
  if (fs::exists(status) && ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0)
    fail_to_write(path);
  if (is_special_file(path, status)) return path;
  const fs::path target = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : target;
}

// --- temporary files ---

// Names of temporary files end with the host name, because locks from other hosts may not be
// visible on this one.
std::string name_end() {
  return fmt::format("@{}.tmp", host_name());
}

// The name contains the time, because process ids are reused after a crash and in containers.
fs::path unused_name(const fs::path& folder) {
  static std::atomic<unsigned> count{0};
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return folder / fmt::format("{}{}-{}-{}{}", kTemporary, ::getpid(), now, count++, name_end());
}

// True if the process that created the temporary file was killed, which is so if the file is not
// locked. A file from another host must also be older than kMaxPause.
bool is_abandoned(const fs::path& path, int fd) {
  std::error_code error;
  const auto age = fs::file_time_type::clock::now() - fs::last_write_time(path, error);
  const bool is_ours = path.filename().string().ends_with(name_end());
  return (is_ours || (!error && age > kMaxPause)) && lock(fd) == LockResult::kLocked;
}

// Removes temporary files that killed processes have left in the folder. This can remove a file
// that another process has created but not locked yet. That process detects this and creates a new
// file.
void clear_abandoned(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(kTemporary) || !name.ends_with(".tmp")) continue;
    const FileDescriptor file(entry->path(), O_WRONLY | O_NONBLOCK | O_NOFOLLOW);
    if (file.is_open() && is_abandoned(entry->path(), file.get())) ::unlink(entry->path().c_str());
  }
}

// Clears each folder only once per process, because this takes time in large folders.
void clear_abandoned_once(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> cleared;
  const std::lock_guard guard(mutex);
  if (cleared.insert(folder).second) clear_abandoned(folder);
}

// Creates an empty file, which is locked while it is open, if the file system supports locks.
// Returns a descriptor that is not open if the file cannot be created. Returns nullopt if another
// process has removed the file as abandoned, or is about to.
std::optional<FileDescriptor> make_locked(const fs::path& path) {
  FileDescriptor file(path, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.is_open()) return file;
  struct stat status {};
  const bool is_locked = lock(file.get()) != LockResult::kHeld;
  const bool is_there = ::fstat(file.get(), &status) == 0 && status.st_nlink > 0;
  return is_locked && is_there ? std::optional(std::move(file)) : std::nullopt;
}

// Flushes a folder to disk, so that a renamed file keeps its new name after a system crash.
void flush_directory(const fs::path& directory) {
  const FileDescriptor handle(directory.empty() ? "." : directory, O_RDONLY | O_DIRECTORY);
  if (handle.is_open()) (void)::fsync(handle.get());
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : name_(path) {
  fs::file_status status;
  target_ = resolved(path, status);
  if (is_special_file(path, status)) {
    // Appends, because the target of a shell redirection may already contain other output.
    file_.emplace(path, O_WRONLY | O_APPEND | O_NOCTTY);
  } else {
    clear_abandoned_once(target_.parent_path());
    do temporary_ = unused_name(target_.parent_path());
    while (!(file_ = make_locked(temporary_)));
    GROVE_CHECK(temporary_.parent_path() == target_.parent_path(),
                "a temporary file is in the folder of the file that it replaces");
  }
  if (!file_->is_open()) fail_to_write(name_);
  if (!temporary_.empty() && fs::exists(status))
    (void)::fchmod(file_->get(), static_cast<mode_t>(status.permissions()));
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  GROVE_CHECK(!is_committed_, "no bytes are written to a file after commit()");
  if (!write_all(file_->get(), bytes)) fail_to_write(name_);
}

void AtomicFile::commit(Durability durability) {
  GROVE_CHECK(!is_committed_, "a file is committed once");
  is_committed_ = true;
  const bool is_flushed = durability == Durability::kMachine && !temporary_.empty();
  if (is_flushed && ::fsync(file_->get()) != 0) fail_to_write(name_);
  if (!file_->reports_no_error()) fail_to_write(name_);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail_to_write(name_);
  temporary_.clear();
  if (is_flushed) flush_directory(target_.parent_path());
}

void write_file_atomically(const fs::path& path, std::string_view content, Durability durability) {
  AtomicFile file(path);
  file.write(content);
  file.commit(durability);
}

bool is_special_file(const fs::path& path) {
  std::error_code error;
  return is_special_file(path, fs::status(path, error));
}

bool is_special_file(const fs::path& path, const fs::file_status& status) {
  if (!fs::exists(status)) return false;
  const std::string name = path.lexically_normal().string();
  return !fs::is_regular_file(status) || name == "/dev/stdout" || name == "/dev/stderr" ||
         name.starts_with("/dev/fd/") || name.starts_with("/proc/");
}

void flush_file(const fs::path& path) {
  const FileDescriptor file(path, O_RDONLY);
  if (!file.is_open() || ::fsync(file.get()) != 0) fail_to_write(path);
  flush_directory(path.parent_path());
}

void require_writable(const fs::path& path) {
  fs::file_status status;
  resolved(path, status);
  if (!is_special_file(path, status)) const AtomicFile probe(path);
}

void require_distinct_files(const fs::path& file, const fs::path& other,
                            std::string_view what_other) {
  if (file.empty() || other.empty()) return;
  std::error_code error;
  const bool same_name =
      fs::absolute(file, error).lexically_normal() == fs::absolute(other, error).lexically_normal();
  if (same_name || fs::equivalent(file, other, error))
    throw InputError(file.string(), "",
                     fmt::format("is {}; expected another file to write to", what_other));
}

}  // namespace grove::detail
