// SPDX-License-Identifier: MIT
// A folder of a test's own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// Made on construction, removed with all its files on destruction.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  // Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view content) const;
  // The names of all files, hidden ones too, in order.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

// The bytes of a file; throws std::runtime_error when there is none.
std::string file_content(const std::filesystem::path& path);

}  // namespace grove::detail
