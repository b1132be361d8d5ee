// SPDX-License-Identifier: MIT
// Simulates a full disk by limiting the size of files.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace grove::detail {

// During its lifetime no file of this process can grow beyond `bytes` bytes, and SIGXFSZ is
// ignored.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

}  // namespace grove::detail
