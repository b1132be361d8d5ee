// SPDX-License-Identifier: MIT
// Checks that a command writes neither to a file that it reads nor twice to the same file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/instance_file.h"
#include "tools/common/instance_arguments.h"

namespace grove::detail {

struct OutputFile {
  std::string option;  // option that names the file
  std::string file;    // "" if the option is not given
};

// Throws CLI::ValidationError if one of `files` is "-", which is not a file. Throws InputError if
// one of them is the instance, its map or one of `plans`, or if two of them are the same file.
void require_distinct_outputs(const std::vector<OutputFile>& files,
                              const InstanceArguments& instance, const LoadedInstance& loaded,
                              const std::vector<std::string>& plans);

}  // namespace grove::detail
