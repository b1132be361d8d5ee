// SPDX-License-Identifier: MIT
/// \file
/// Symbol visibility of the shared library.
#pragma once

/// Gives a symbol of the public API default visibility, so that the shared library exports it.
#if defined(_WIN32) || defined(__CYGWIN__)
#define GROVE_API
#else
#define GROVE_API __attribute__((visibility("default")))
#endif
