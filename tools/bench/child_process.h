// SPDX-License-Identifier: MIT
// Runs a program as a child process and waits until it ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grove::detail::bench {

struct ChildLimits {
  double seconds = 0;               // time limit; then the child and its process group are killed
  std::function<bool()> cancelled;  // polled several times a second; true: kill the process group
  std::optional<double> memory_gb = {};  // limit of the data segment (RLIMIT_DATA); nullopt: none
  // Time in seconds from an arbitrary origin; empty: the system's steady clock.
  std::function<double()> clock = {};
};

struct ChildEnd {
  enum class Kind : std::uint8_t {
    kExited,     // ended by itself with exit code `code`
    kSignalled,  // ended by signal `code`
    kTooLong,    // killed at the time limit
    kCancelled,  // killed because `cancelled` returned true
  };
  Kind kind = Kind::kExited;
  int code = 0;
  double wall_s = 0;          // from start to end
  double peak_memory_mb = 0;  // maximum resident set of the child or a process that it ran, MB
};

// Exit code of a child that could not start the program, as in shells.
inline constexpr int kCannotBeStarted = 127;

// Runs `command` (a program and its arguments) and waits until it ends. Its standard input is
// /dev/null; standard output and standard error go to `output_file`. The kernel kills the child
// when the calling thread ends, for whatever reason. The child has a process group of its own, so
// that Ctrl-C reaches only the caller; processes of the group that outlive the child are killed. If
// the program cannot be started, the exit code is kCannotBeStarted. Throws std::system_error if the
// process or a file cannot be created. Thread-safe.
ChildEnd run_child(const std::vector<std::string>& command,
                   const std::filesystem::path& output_file, const ChildLimits& limits);

}  // namespace grove::detail::bench
