// SPDX-License-Identifier: MIT
// Assertions: what a caller promised, or the code around believes, checked where builds ask for it.
#pragma once

#include <stdexcept>
#include <string>

namespace grove::detail {

// Thrown by an assertion that does not hold: somebody's code is wrong. Programs end with exit
// code 1.
struct AssertionFailed : std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn]] inline void assertion_failed(const char* file, int line, const char* what) {
  throw AssertionFailed(std::string(file) + ":" + std::to_string(line) +
                        ": does not hold: " + what);
}

}  // namespace grove::detail

// GROVE_ASSERT(condition, what): cheap checks, O(1) or hidden by what is done anyway. `what` says
// what should hold. In builds without GROVE_ASSERTIONS (Release) the condition is compiled, not
// evaluated.
#ifdef GROVE_ASSERTIONS
#define GROVE_ASSERT(condition, what) \
  ((condition) ? void(0) : ::grove::detail::assertion_failed(__FILE__, __LINE__, what))
#else
#define GROVE_ASSERT(condition, what) (true ? void(0) : void(condition))
#endif
