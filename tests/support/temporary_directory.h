// SPDX-License-Identifier: MIT
// Temporary directory for one test.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// A directory that exists during the lifetime of this object; the destructor removes it with all
// its files.
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
  // The names of all entries of the directory, including hidden ones, in ascending order.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

// Returns the bytes of a file. Throws std::runtime_error if the file cannot be opened.
std::string file_content(const std::filesystem::path& path);

}  // namespace grove::detail
