// SPDX-License-Identifier: MIT
// Running a program to its end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grove::detail::bench {

struct ChildLimits {
  double seconds = 0;                    // then it is killed, and what it has started with it
  std::function<bool()> cancelled;       // asked several times a second; then likewise
  std::optional<double> memory_gb = {};  // of data; it gets no more
  // In seconds, from any moment on; empty: the system's.
  std::function<double()> clock = {};
};

struct ChildEnd {
  enum class Kind : std::uint8_t {
    kExited,     // by itself: `code` is its exit code
    kSignalled,  // ended by the signal `code`
    kTooLong,    // killed at the limit
    kCancelled,  // killed because that was asked for
  };
  Kind kind = Kind::kExited;
  int code = 0;
  double wall_s = 0;          // from its start to its end
  double peak_memory_mb = 0;  // resident
};

inline constexpr int kCannotBeStarted = 127;

// Runs `command`, a program and its arguments, and waits for it; nothing is on its standard input,
// and what it says goes to the file `said`. It dies with this process, however that ends, and is in
// a process group of its own: a Ctrl-C is for the caller alone, and what it leaves running in that
// group dies with it. A program that cannot be started exits with kCannotBeStarted. Of any thread,
// which must live as long. Throws std::system_error when there are no more processes or files.
ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& said,
                   const ChildLimits& limits);

}  // namespace grove::detail::bench
