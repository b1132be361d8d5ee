// SPDX-License-Identifier: MIT
#include "grove/detail/io/file_lock.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <ctime>
#include <string>

#include "grove/detail/io/input_error.h"
#include "grove/detail/io/text_file.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

std::string who_i_am() {
  return fmt::format("process {} on host {}, since {:%F %T} UTC", ::getpid(), host_name(),
                     fmt::gmtime(std::time(nullptr)));
}

[[noreturn]] void refuse(const fs::path& path) {
  const std::string holder = read_text(path);
  throw InputError(path.string(), "",
                   fmt::format("is locked by another run ({}), which must have ended first",
                               holder.empty() ? "it has just begun" : holder));
}

}  // namespace

FileLock::FileLock(const fs::path& path) : file_(path, O_RDWR | O_CREAT) {
  if (!file_.is_open()) fail_to_write(path);
  const LockResult result = lock(file_.get());
  if (result == LockResult::kHeld) refuse(path);
  held_ = result == LockResult::kLocked;
  if (::ftruncate(file_.get(), 0) != 0 || !write_all(file_.get(), who_i_am())) fail_to_write(path);
}

}  // namespace grove::detail
