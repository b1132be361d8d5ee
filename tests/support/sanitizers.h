// SPDX-License-Identifier: MIT
// Whether a sanitizer is on whose own memory fills the limit of a test: that of addresses or
// threads.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GROVE_SANITIZERS_MEMORY 1  // GCC
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define GROVE_SANITIZERS_MEMORY 1  // clang
#endif
#endif
