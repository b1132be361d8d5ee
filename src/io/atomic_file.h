// SPDX-License-Identifier: MIT
// Atomic replacement of files: at any time a file has either its old or its complete new content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "io/file_descriptor.h"

namespace grove::detail {

// The events that a written file survives: kProcess: any end of this process; kMachine: also a
// system crash. With kMachine the writer waits for the disk, which can take seconds on a busy
// machine.
enum class Durability : std::uint8_t { kProcess, kMachine };

// Replaces the file at `path`, or the file to which it links, atomically. write() writes to a
// temporary file in the same folder. commit() flushes the temporary file to disk for
// Durability::kMachine, and renames it. Without commit() the old file remains, and the destructor
// removes the temporary file. (If the process is killed, the temporary file .grove-*.tmp remains
// until a later process writes in that folder; if this is on another host, at least one hour
// later.) Special files are written to directly. One thread at a time. All functions except the
// destructor throw InputError on failure; after that the object can only be destroyed. For SIGXFSZ
// see write_file_atomically().
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  // Replaces the file. Call it at most once, after the last write().
  void commit(Durability durability = Durability::kMachine);

 private:
  const std::filesystem::path name_;  // path as passed by the caller, for messages
  std::filesystem::path target_;      // with symbolic links resolved
  std::filesystem::path temporary_;   // empty: special file, or renamed by commit()
  std::optional<FileDescriptor> file_;
  bool is_committed_ = false;
};

// Replaces the content of the file at `path` by `content`, as AtomicFile does. On failure, removes
// the temporary file, leaves the old file unchanged, and throws InputError. Special files (devices,
// pipes, /dev/stdout) are written to directly. A program that may run under a file size limit must
// ignore SIGXFSZ; otherwise this signal terminates the program when a write exceeds the limit.
void write_file_atomically(const std::filesystem::path& path, std::string_view content,
                           Durability durability = Durability::kMachine);

// True if write_file_atomically() writes directly to this file. This includes /dev/stdout,
// /dev/stderr, /dev/fd/* and /proc/* even if they are regular files, because other processes may
// have these files open. `status` is the status of the file to which `path` leads.
bool is_special_file(const std::filesystem::path& path);
bool is_special_file(const std::filesystem::path& path, const std::filesystem::file_status& status);

// Flushes the file at `path` to disk. For files that were written with Durability::kProcess. Throws
// InputError on failure. Thread-safe.
void flush_file(const std::filesystem::path& path);

// Throws InputError if write_file_atomically(path) would fail now, for example because the folder
// does not exist, a permission is missing, or `path` is a directory. Call it before a long run. It
// leaves no file behind.
void require_writable(const std::filesystem::path& path);

// Throws InputError ("`file` is `what_other`") if both paths refer to the same file, whether it
// exists or not, because writing `file` would destroy `other`. Does nothing if one of the paths is
// empty.
void require_distinct_files(const std::filesystem::path& file, const std::filesystem::path& other,
                            std::string_view what_other);

}  // namespace grove::detail
