// SPDX-License-Identifier: MIT
#include "tools/common/progress_style.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace grove::detail {

batch::ProgressStyle stderr_style() {
  batch::ProgressStyle style;
  style.terminal = ::isatty(STDERR_FILENO) == 1;
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    style.columns = size.ws_col;
  style.write = [](std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  };
  return style;
}

}  // namespace grove::detail
