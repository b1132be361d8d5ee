// SPDX-License-Identifier: MIT
// Has an instance changed since it was solved?
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "grove/batch/entry.h"

namespace grove::batch {

// Digests of instances: of the bytes of the instance file and of its map, 64 bits in hexadecimal
// digits. They tell a change; they do not withstand forgery. A file that cannot be read counts as
// empty. Maps are read once per object.
class InstanceDigests {
 public:
  std::string of(const Entry& entry);

 private:
  std::uint64_t of_map(const std::filesystem::path& map);

  std::map<std::filesystem::path, std::uint64_t> maps_;
};

}  // namespace grove::batch
