// SPDX-License-Identifier: MIT
// Runs the program grove for tests.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/subprocess.h"

namespace grove::detail {

inline ProcessResult run_grove(std::vector<std::string> arguments,
                               const ProcessOptions& options = {}) {
  arguments.insert(arguments.begin(), GROVE_PROGRAM);
  return run_program(arguments, options);
}

// Returns the single line that a run with bad input or usage prints on stderr, without "grove:
// error: ". If the run did not end in this way, returns a description of the difference.
inline std::string complaint(const ProcessResult& result) {
  const std::string start = "grove: error: ";
  if (result.exit_code != 2)
    return "exit code " + std::to_string(result.exit_code) + " " + result.err;
  if (!result.out.empty()) return "wrote to stdout: " + result.out;
  if (std::ranges::count(result.err, '\n') != 1 || !result.err.ends_with('\n'))
    return "not one line: " + result.err;
  if (!result.err.starts_with(start)) return "does not begin as it should: " + result.err;
  return result.err.substr(start.size(), result.err.size() - start.size() - 1);
}

}  // namespace grove::detail
