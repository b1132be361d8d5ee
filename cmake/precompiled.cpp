// SPDX-License-Identifier: MIT
// The only source of the library that provides the precompiled header, because a library needs a
// source.
