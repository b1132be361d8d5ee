// SPDX-License-Identifier: MIT
#include "grove/batch/entry.h"

namespace grove::batch {

LoadedInstance load(const Entry& entry) {
  return entry.agents > 0 ? read_scenario_instance(entry.path, entry.map, entry.agents)
                          : read_instance(entry.path);
}

}  // namespace grove::batch
