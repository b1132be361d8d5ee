// SPDX-License-Identifier: MIT
#include "tools/common/own_files.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>

#include "io/atomic_file.h"

namespace grove::detail {

void require_distinct_outputs(const std::vector<OutputFile>& files,
                              const InstanceArguments& instance, const LoadedInstance& loaded,
                              const std::vector<std::string>& plans) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [option, file] = files[i];
    if (file.empty()) continue;
    if (file == "-") throw CLI::ValidationError(option, "found '-'; expected the name of a file");
    require_distinct_files(file, instance.path(), "the instance");
    require_distinct_files(file, loaded.map_path, "the map");
    for (const std::string& plan : plans) require_distinct_files(file, plan, "the plan");
    for (std::size_t k = 0; k < i; ++k)
      require_distinct_files(file, files[k].file, fmt::format("the output of {}", files[k].option));
  }
}

}  // namespace grove::detail
