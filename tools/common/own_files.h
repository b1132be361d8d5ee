// SPDX-License-Identifier: MIT
// Files that a command writes must not be those that it reads, or each other.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/instance_file.h"
#include "tools/common/instance_arguments.h"

namespace grove::detail {

struct OwnFile {
  std::string option;  // by which it is named
  std::string file;    // empty: none
};

// Throws CLI::ValidationError for "-", which is no file; InputError where a file is the instance,
// its map, one of `plans`, or another one of the files.
void require_own_files(const std::vector<OwnFile>& files, const InstanceArguments& instance,
                       const LoadedInstance& loaded, const std::vector<std::string>& plans);

}  // namespace grove::detail
