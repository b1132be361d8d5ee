// SPDX-License-Identifier: MIT
// The formats that grove convert knows, by the names of --from and --to.
#pragma once

#include <cstdint>
#include <string>

namespace grove::detail {

enum class InstanceFormat : std::uint8_t { kGrove, kLibmrp, kMgcbs, kMapfw, kScen };
enum class PlanFormat : std::uint8_t {
  kLibmrp,
  kVisualizer,
  kEecbs,
  kTracker,
  kTrackerCsv,
  kWaypoints,
  kNavPath,
  kPlanViz,
};

// The format called `name`; if that is empty, the one that the suffix of `file` tells. Throw
// CLI::ValidationError, naming `option`, when there is none.
InstanceFormat instance_format(const std::string& option, const std::string& name,
                               const std::string& file);
PlanFormat plan_format(const std::string& option, const std::string& name, const std::string& file);

// Instances of this format name a map file; the others hold their map.
bool names_a_map(InstanceFormat format);
bool holds_tasks(InstanceFormat format);

// Its suffix is that of a format that only 'grove convert' reads.
bool is_called_like_another_tools_instance(const std::string& file);

// `file` without the suffix of a format: "x" of "x.cts.json".
std::string without_suffix(const std::string& file);

}  // namespace grove::detail
