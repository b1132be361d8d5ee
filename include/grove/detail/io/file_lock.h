// SPDX-License-Identifier: MIT
// A folder that one run at a time may write to.
#pragma once

#include <filesystem>

#include "grove/detail/io/descriptor.h"

namespace grove::detail {

// Holds the lock that the file at `path` stands for, until it or the process ends, however that
// comes: the file is left behind, a lock never is. The file says who holds it. A lock counts on all
// hosts that share the file system. Not to be shared by threads.
class FileLock {
 public:
  // Throws InputError when another holds it, and says who; and when the file cannot be written.
  explicit FileLock(const std::filesystem::path& path);

  // False where the file system knows no locks: then nobody is kept away.
  bool is_held() const { return held_; }

 private:
  Descriptor file_;
  bool held_ = true;
};

}  // namespace grove::detail
