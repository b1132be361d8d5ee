// SPDX-License-Identifier: MIT
// Files that appear whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "io/file_descriptor.h"

namespace grove::detail {

// What a file that was written outlives: this process, however it ends, or a crash of the machine
// too. To wait until the disk has it can take seconds, where others keep the machine busy.
enum class Durability : std::uint8_t { kProcess, kMachine };

// The file at `path`, replaced piece by piece: written beside it under a temporary name, flushed to
// disk if it is to outlive the machine, and renamed by commit(). Without that the old file stands
// and the temporary one goes with this object (a process that is killed leaves it behind, as
// .grove-*.tmp, until the next one writes in that folder). Special files are written to directly.
// For one thread. All but the destructor throw InputError; what can be done then is to destroy
// this. See write_file_atomically on SIGXFSZ.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  // To be called once, last.
  void commit(Durability outlives = Durability::kMachine);

 private:
  const std::filesystem::path name_;  // as it was given, for messages
  std::filesystem::path target_;      // behind a symbolic link
  std::filesystem::path temporary_;   // empty: there is none, for the file is special, or no more
  std::optional<FileDescriptor> file_;
};

// Replaces the file at `path` by `content`: written beside it under a temporary name, flushed to
// disk if it is to outlive the machine, and renamed. On failure the old file stands, the temporary
// one is gone, and InputError is thrown. Special files (devices, pipes, /dev/stdout) are written to
// directly. A program that may run under a limit on file sizes must ignore SIGXFSZ, or the signal
// ends it half-way.
void write_file_atomically(const std::filesystem::path& path, std::string_view content,
                           Durability outlives = Durability::kMachine);

// Waits until the disk has the file at `path`, which was to outlive the process alone so far. Of
// any thread. Throws InputError.
void flush_file(const std::filesystem::path& path);

// Throws InputError when write_file_atomically(path) would fail now (no such folder, no permission,
// a directory of that name): ask before a long run. Leaves nothing behind.
void require_writable(const std::filesystem::path& path);

// Throws InputError ("`file` is `what_other`") when both paths lead to one file, existing or not:
// writing the one would destroy the other. Empty paths lead nowhere.
void require_distinct_files(const std::filesystem::path& file, const std::filesystem::path& other,
                            std::string_view what_other);

}  // namespace grove::detail
