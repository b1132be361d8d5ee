// SPDX-License-Identifier: MIT
#include "io/special_file.h"

#include <string>
#include <system_error>

namespace grove::detail {

namespace fs = std::filesystem;

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

}  // namespace grove::detail
