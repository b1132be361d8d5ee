// SPDX-License-Identifier: MIT
// Atomic replacement of files: a file is either complete or unchanged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "io/file_descriptor.h"

namespace grove::detail {

// What a written file survives: any end of this process, or also a system crash. Waiting for the
// disk can take seconds if other processes keep the machine busy.
enum class Durability : std::uint8_t { kProcess, kMachine };

// Replaces the file at `path` atomically. The content is written to a temporary file in the same
// folder, flushed to disk for Durability::kMachine, and renamed by commit(). Without commit() the
// old file stays, and the destructor removes the temporary one. (A process that is killed leaves it
// behind, as .grove-*.tmp, until the next process writes in that folder.) Special files are written
// to directly. One thread at a time. All functions except the destructor throw InputError; after
// that the object can only be destroyed. For SIGXFSZ see write_file_atomically().
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  // Call it once, as the last function.
  void commit(Durability outlives = Durability::kMachine);

 private:
  const std::filesystem::path name_;  // as the caller specified it, for messages
  std::filesystem::path target_;      // with symbolic links resolved
  std::filesystem::path
      temporary_;  // empty: the file is special, or commit() has renamed the temporary file
  std::optional<FileDescriptor> file_;
};

// Replaces the file at `path` by `content`: writes it to a temporary file in the same folder,
// flushes this to disk for Durability::kMachine, and renames it. On failure the old file stays, the
// temporary one is removed, and InputError is thrown. Special files (devices, pipes, /dev/stdout)
// are written to directly. A program that may run under a limit on file sizes must ignore SIGXFSZ,
// or the signal terminates it during the write.
void write_file_atomically(const std::filesystem::path& path, std::string_view content,
                           Durability outlives = Durability::kMachine);

// True if write_file_atomically() writes directly to this file. This includes /dev/stdout, even if
// it is a regular file, because other processes have it open.
bool is_special_file(const std::filesystem::path& path);
bool is_special_file(const std::filesystem::path& path, const std::filesystem::file_status& status);

// Waits until the file at `path`, which was written with Durability::kProcess, is on the disk.
// Thread-safe. Throws InputError.
void flush_file(const std::filesystem::path& path);

// Throws InputError if write_file_atomically(path) would fail now (no such folder, no permission, a
// directory of that name). Call it before a long run. Leaves no file behind.
void require_writable(const std::filesystem::path& path);

// Throws InputError ("`file` is `what_other`") if both paths lead to the same file, existing or
// not, because writing one would destroy the other. Does nothing if a path is empty.
void require_distinct_files(const std::filesystem::path& file, const std::filesystem::path& other,
                            std::string_view what_other);

}  // namespace grove::detail
