// SPDX-License-Identifier: MIT
// What users of the library may call.
#pragma once

#if defined(_WIN32) || defined(__CYGWIN__)
#define GROVE_API
#else
#define GROVE_API __attribute__((visibility("default")))
#endif
