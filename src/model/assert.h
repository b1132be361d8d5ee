// SPDX-License-Identifier: MIT
// Assertions: cheap run-time checks of preconditions and invariants.
#pragma once

#include <stdexcept>
#include <string>

namespace grove::detail {

// Thrown by a failed assertion or audit (search/audit.h), which indicates an error in the code.
// Programs then end with exit code 1.
struct AssertionFailed : std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn]] inline void assertion_failed(const char* file, int line, const char* what) {
  throw AssertionFailed(std::string(file) + ":" + std::to_string(line) +
                        ": does not hold: " + what);
}

}  // namespace grove::detail

// GROVE_CHECK(condition, what): for checks outside inner loops, whose cost cannot be measured. They
// are evaluated in every build. `what` states the property that should hold.
#define GROVE_CHECK(condition, what) \
  ((condition) ? void(0) : ::grove::detail::assertion_failed(__FILE__, __LINE__, what))

// GROVE_ASSERT(condition, what): for checks that cost O(1), or little compared with the surrounding
// code. In builds without GROVE_ASSERTIONS (Release) the condition is compiled but not evaluated.
#ifdef GROVE_ASSERTIONS
#define GROVE_ASSERT(condition, what) GROVE_CHECK(condition, what)
#else
#define GROVE_ASSERT(condition, what) (true ? void(0) : void(condition))
#endif
