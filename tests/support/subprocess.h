// SPDX-License-Identifier: MIT
// Running a program as its users do.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace grove::detail {

struct ProcessResult {
  int exit_code = -1;  // as a shell tells it: 128 + the signal that ended it
  bool timed_out = false;
  std::string out;
  std::string err;
};

struct ProcessOptions {
  std::string directory;                // to run in; empty: where the test runs
  std::string input = {};               // on stdin
  std::chrono::minutes timeout{5};      // then it is killed: it hangs
  rlim_t largest_file = RLIM_INFINITY;  // in bytes; counts for out and err too
  // Sends `signal` once, as soon as `signal_when` says so; 0: never.
  int signal = 0;
  std::function<bool()> signal_when = {};
};

// Runs `command` (program and arguments, no shell) and waits for it. Throws
// std::runtime_error when it cannot be started.
ProcessResult run_program(const std::vector<std::string>& command,
                          const ProcessOptions& options = {});

}  // namespace grove::detail
