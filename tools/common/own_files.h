// SPDX-License-Identifier: MIT
// Checks that a command does not write to a file that it reads, nor twice to one file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/instance_file.h"
#include "tools/common/instance_arguments.h"

namespace grove::detail {

struct OwnFile {
  std::string option;  // by which the file is named
  std::string file;    // "" if the option is not given
};

// Throws CLI::ValidationError for "-", which is not a file. Throws InputError if a file is the
// instance, its map, one of `plans`, or another one of the files.
void require_own_files(const std::vector<OwnFile>& files, const InstanceArguments& instance,
                       const LoadedInstance& loaded, const std::vector<std::string>& plans);

}  // namespace grove::detail
