// SPDX-License-Identifier: MIT
// Moving AI benchmark maps and scenarios, which are not part of this project. A test that uses them
// starts with: if (!has_movingai()) GTEST_SKIP() << movingai_missing();
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace grove::detail {

// The directory that the environment variable GROVE_MOVINGAI names, or the default of the build if
// it is unset.
inline std::filesystem::path movingai_directory() {
  const char* named = std::getenv("GROVE_MOVINGAI");
  return named ? named : GROVE_MOVINGAI_DEFAULT;
}

inline bool has_movingai() {
  return std::filesystem::exists(movingai_directory() / "room-32-32-4.map");
}

inline std::string movingai_missing() {
  return "no Moving AI maps in " + movingai_directory().string() + " (set GROVE_MOVINGAI)";
}

}  // namespace grove::detail
