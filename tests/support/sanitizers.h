// SPDX-License-Identifier: MIT
// GROVE_SANITIZERS_MEMORY is defined if AddressSanitizer or ThreadSanitizer is on. Their own memory
// would exceed the memory limits of tests.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GROVE_SANITIZERS_MEMORY 1  // GCC
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define GROVE_SANITIZERS_MEMORY 1  // clang
#endif
#endif
