// SPDX-License-Identifier: MIT
#include "grove/io/file_lock.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <string>
#include <system_error>

#include "descriptor.h"
#include "grove/io/input_error.h"
#include "grove/io/text_file.h"

namespace grove {
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

FileLock::FileLock(const fs::path& path)
    : file_(std::make_unique<Descriptor>(path, O_RDWR | O_CREAT)) {
  const auto cannot = [&] {
    throw InputError(path.string(), "",
                     "cannot be written: " + std::generic_category().message(errno));
  };
  if (!file_->is_open()) cannot();
  const LockResult result = lock(file_->get());
  if (result == LockResult::kHeld) refuse(path);
  held_ = result == LockResult::kLocked;
  if (::ftruncate(file_->get(), 0) != 0 || !write_all(file_->get(), who_i_am())) cannot();
}

FileLock::FileLock(FileLock&&) noexcept = default;
FileLock& FileLock::operator=(FileLock&&) noexcept = default;
FileLock::~FileLock() = default;

}  // namespace grove
