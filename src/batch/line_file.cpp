// SPDX-License-Identifier: MIT
#include "grove/batch/line_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "grove/io/input_error.h"
#include "grove/io/text_file.h"

namespace grove::batch {

std::vector<std::string_view> whole_lines(std::string_view text) {
  return split_lines(text.substr(0, text.rfind('\n') + 1));
}

LineFile::LineFile(std::filesystem::path path)
    : path_(std::move(path)),
      fd_(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666)) {
  if (fd_ < 0) fail();
}

LineFile::~LineFile() {
  ::close(fd_);
}

// One write() as a rule; a file system may do less at a time.
void LineFile::append(std::string_view lines) {
  while (!lines.empty()) {
    const ssize_t written = ::write(fd_, lines.data(), lines.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    lines.remove_prefix(static_cast<std::size_t>(written));
  }
}

void LineFile::flush() {
  if (::fsync(fd_) != 0) fail();
}

void LineFile::fail() const {
  throw InputError(path_.string(), "",
                   "cannot be written: " + std::generic_category().message(errno));
}

}  // namespace grove::batch
