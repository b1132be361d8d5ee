// SPDX-License-Identifier: MIT
// Defines GROVE_SANITIZERS_MEMORY if AddressSanitizer or ThreadSanitizer is on. Their own memory
// use would exceed the memory limits set by tests.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GROVE_SANITIZERS_MEMORY 1  // GCC
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define GROVE_SANITIZERS_MEMORY 1  // clang
#endif
#endif
