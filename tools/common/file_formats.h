// SPDX-License-Identifier: MIT
// The file formats of grove convert, by the names of --from and --to.
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

// Returns the format called `name`; if `name` is empty, the format of the suffix of `file`. Throw
// CLI::ValidationError, which names `option`, if there is none.
InstanceFormat instance_format(const std::string& option, const std::string& name,
                               const std::string& file);
PlanFormat plan_format(const std::string& option, const std::string& name, const std::string& file);

// Whether instances of this format name a map file; other formats contain their map.
bool names_a_map(InstanceFormat format);
bool holds_tasks(InstanceFormat format);

// Whether the suffix of `file` is that of a format that only 'grove convert' reads.
bool has_suffix_of_other_format(const std::string& file);

// Returns `file` without the suffix of a format: "x" of "x.cts.json".
std::string without_suffix(const std::string& file);

}  // namespace grove::detail
