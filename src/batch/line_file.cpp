// SPDX-License-Identifier: MIT
#include "batch/line_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <utility>

#include "io/input_error.h"
#include "io/text_file.h"

namespace grove::detail::batch {

std::vector<std::string_view> whole_lines(std::string_view text) {
  return split_lines(text.substr(0, text.rfind('\n') + 1));
}

LineFile::LineFile(std::filesystem::path path)
    : path_(std::move(path)), file_(path_, O_WRONLY | O_APPEND | O_CREAT) {
  if (!file_.is_open()) fail_to_write(path_);
}

void LineFile::append(std::string_view lines) {
  if (!write_all(file_.get(), lines)) fail_to_write(path_);
}

void LineFile::flush() {
  if (::fsync(file_.get()) != 0) fail_to_write(path_);
}

}  // namespace grove::detail::batch
