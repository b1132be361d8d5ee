// SPDX-License-Identifier: MIT
// Runs a program as a child process until it ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grove::detail::bench {

struct ChildLimits {
  double seconds = 0;                    // then the child and its process group are killed
  std::function<bool()> cancelled;       // polled several times a second; true: kill them as well
  std::optional<double> memory_gb = {};  // limit of the data segment (RLIMIT_DATA)
  // Time in seconds from an arbitrary origin; empty: the system's steady clock.
  std::function<double()> clock = {};
};

struct ChildEnd {
  enum class Kind : std::uint8_t {
    kExited,     // by itself; `code` is its exit code
    kSignalled,  // by signal `code`
    kTooLong,    // killed at the time limit
    kCancelled,  // killed because `cancelled` returned true
  };
  Kind kind = Kind::kExited;
  int code = 0;
  double wall_s = 0;          // from start to end
  double peak_memory_mb = 0;  // resident set
};

inline constexpr int kCannotBeStarted = 127;

// Runs `command` (a program and its arguments) and waits for it. Its standard input is /dev/null;
// standard output and standard error go to the file `output_file`. The child is killed when the
// calling thread ends, in whatever way. It has a process group of its own, so Ctrl-C reaches only
// the caller, and processes of that group that are still running when the child ends are killed. A
// program that cannot be started exits with kCannotBeStarted. Thread-safe. Throws std::system_error
// if the system has no more processes or files.
ChildEnd run_child(const std::vector<std::string>& command,
                   const std::filesystem::path& output_file, const ChildLimits& limits);

}  // namespace grove::detail::bench
