// SPDX-License-Identifier: MIT
/// \file
/// Symbol visibility of the shared library.
#pragma once

/// Marks a symbol of the public API.
#if defined(_WIN32) || defined(__CYGWIN__)
#define GROVE_API
#else
#define GROVE_API __attribute__((visibility("default")))
#endif
