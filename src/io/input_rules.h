// SPDX-License-Identifier: MIT
// Rules for untrusted files: the files that they may name, and the memory that their content may
// take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace grove::detail {

struct InputRules {
  // A file may only name files in its own folder or below it.
  bool confined = false;
  // Maximum number of bytes for a map, a roadmap and the states of agents on it together.
  std::size_t memory = std::numeric_limits<std::size_t>::max();

  friend bool operator==(const InputRules&, const InputRules&) = default;
};

// Upper estimates of the peak memory while a world is constructed, in bytes. Measured: at most 38
// per cell, 79 per place and 65 per state.
inline constexpr std::size_t kBytesPerCell = 56;
inline constexpr std::size_t kBytesPerPlace = 128;  // of a roadmap
inline constexpr std::size_t kBytesPerState = 80;   // of agents that turn or work

// Bytes that are granted even if rules.memory is less.
inline constexpr std::size_t kAlwaysGranted = std::size_t{64} << 20;

// Throws InputError at `place` of `file` if `count` objects of `bytes_each` bytes take more than
// rules.memory. `what` names them ("cells"). kAlwaysGranted bytes are always granted.
void require_memory(const InputRules& rules, std::string_view file, std::string_view place,
                    std::int64_t count, std::string_view what, std::size_t bytes_each);

// The file that `name` refers to, relative to `folder`. With rules.confined it is a canonical path
// in this folder or below. Then throws std::invalid_argument for an absolute name, and for one that
// leaves the folder by ".." or by a symbolic link.
std::filesystem::path file_in_folder(const InputRules& rules, const std::filesystem::path& folder,
                                     const std::filesystem::path& name);

}  // namespace grove::detail
