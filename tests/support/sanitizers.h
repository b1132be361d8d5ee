// SPDX-License-Identifier: MIT
// Whether the address sanitizer is on, whose own memory fills the limit of a test.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define GROVE_ADDRESS_SANITIZER 1  // GCC
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GROVE_ADDRESS_SANITIZER 1  // clang
#endif
#endif
