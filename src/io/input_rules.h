// SPDX-License-Identifier: MIT
// Rules for reading untrusted files: which files they may name, and how much memory their content
// may take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace grove::detail {

struct InputRules {
  // True if a file may name only files in its own folder or below it.
  bool confined = false;
  // Maximum memory in bytes for a map, for the states of agents on it, and for the agents of tasks
  // of all agents.
  std::size_t memory = std::numeric_limits<std::size_t>::max();

  friend bool operator==(const InputRules&, const InputRules&) = default;
};

// Estimates of the peak memory for constructing a world, in bytes, with a margin. Measured were at
// most 38 bytes per cell, 79 per place and 65 per state.
inline constexpr std::size_t kBytesPerCell = 56;
inline constexpr std::size_t kBytesPerPlace = 128;  // place of a roadmap
inline constexpr std::size_t kBytesPerState = 80;   // state of agents that turn or work
// An agent in the list of a task, in the instance and in the public types.
inline constexpr std::size_t kBytesPerVisitor = 64;

// Memory in bytes that is granted even if rules.memory is less.
inline constexpr std::size_t kAlwaysGranted = std::size_t{64} << 20;

// Throws InputError at `place` of `file` if `count` objects of `bytes_each` bytes need more than
// max(rules.memory, kAlwaysGranted) bytes. `what` is the name of the objects in the message, such
// as "cells".
void require_memory(const InputRules& rules, std::string_view file, std::string_view place,
                    std::int64_t count, std::string_view what, std::size_t bytes_each);

// The path of the file `name`, relative to `folder`. With rules.confined the result is a canonical
// path in this folder or below it, and std::invalid_argument is thrown for an absolute name, and
// for a name that leaves the folder by ".." or by a symbolic link.
std::filesystem::path file_in_folder(const InputRules& rules, const std::filesystem::path& folder,
                                     const std::filesystem::path& name);

}  // namespace grove::detail
