// SPDX-License-Identifier: MIT
// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace grove {

// Replaces the file at `path` by `content`: written beside it under a temporary name, flushed to
// disk and renamed. On failure the old file stands, the temporary one is gone, and InputError is
// thrown. Special files (devices, pipes, /dev/stdout) are written to directly. A program
// that may run under a limit on file sizes must ignore SIGXFSZ, or the signal ends it half-way.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

// Throws InputError when write_file_atomically(path) would fail now (no such folder, no permission,
// a directory of that name): ask before a long run. Leaves nothing behind.
void require_writable(const std::filesystem::path& path);

// Throws InputError ("`file` is `what_other`") when both paths lead to one file, existing or not:
// writing the one would destroy the other. Empty paths lead nowhere.
void require_distinct_files(const std::filesystem::path& file, const std::filesystem::path& other,
                            std::string_view what_other);

}  // namespace grove
