// SPDX-License-Identifier: MIT
#include "batch/entry.h"

namespace grove::detail::batch {

LoadedInstance load(const Entry& entry) {
  return entry.agents > 0 ? read_scenario_instance(entry.path, entry.map, entry.agents, entry.rules)
                          : read_instance(entry.path, entry.rules);
}

}  // namespace grove::detail::batch
