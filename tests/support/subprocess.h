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
  int exit_code = -1;  // as in a shell: 128 + N if signal N terminated the program
  bool timed_out = false;
  std::string out;
  std::string err;
};

struct ProcessOptions {
  std::string directory;                // working directory; empty: that of the test program
  std::string input = {};               // standard input
  std::chrono::minutes timeout{5};      // the process is killed after this time
  rlim_t largest_file = RLIM_INFINITY;  // in bytes; applies to standard output and error, too
  // Sent once, as soon as `signal_when` returns true (polled every millisecond); 0: no signal.
  int signal = 0;
  std::function<bool()> signal_when = {};
};

// Runs `command` (program and arguments, without a shell) and waits for it. Throws
// std::runtime_error if the program cannot be started or exits with 127.
ProcessResult run_program(const std::vector<std::string>& command,
                          const ProcessOptions& options = {});

}  // namespace grove::detail
