// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iterator>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/plan_export.h"
#include "io/plan_steps.h"

namespace grove::detail {

void write_path_lists(const std::filesystem::path& path, const Instance& instance,
                      const Solution& solution) {
  require_free_grid(instance, "EECBS's path lists");
  std::string text;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    text += fmt::format("Agent {}: ", i);
    for (Cell cell : until_rest(solution.plan->agents[i].path)) {
      const Position p = instance.grid().position(cell);
      fmt::format_to(std::back_inserter(text), "({},{})->", p.y, p.x);
    }
    text += '\n';
  }
  write_file_atomically(path, text);
}

}  // namespace grove::detail
