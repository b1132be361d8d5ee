// SPDX-License-Identifier: MIT
// Runs a program as a child process, for tests of command-line programs.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace grove::detail {

struct ProcessResult {
  int exit_code = -1;  // as in a shell: 128 + N if signal N ended it
  bool timed_out = false;
  std::string out;
  std::string err;
};

struct ProcessOptions {
  std::string directory;                // working directory; empty: that of the test
  std::string input = {};               // standard input
  std::chrono::minutes timeout{5};      // after this time the process is killed
  rlim_t largest_file = RLIM_INFINITY;  // in bytes; applies to out and err, too
  // Sends `signal` once, as soon as `signal_when` returns true; 0: never.
  int signal = 0;
  std::function<bool()> signal_when = {};
};

// Runs `command` (program and arguments, no shell) and waits for it. Throws std::runtime_error if
// it cannot be started.
ProcessResult run_program(const std::vector<std::string>& command,
                          const ProcessOptions& options = {});

}  // namespace grove::detail
