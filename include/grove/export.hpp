// SPDX-License-Identifier: MIT
/// \file
/// What the shared library shows.
#pragma once

/// Marks what users of the library may call.
#if defined(_WIN32) || defined(__CYGWIN__)
#define GROVE_API
#else
#define GROVE_API __attribute__((visibility("default")))
#endif
