// SPDX-License-Identifier: MIT
// File formats of `grove convert`: the values of --from and --to, and file name suffixes.
#pragma once

#include <cstdint>
#include <string>

namespace grove::detail {

enum class InstanceFormat : std::uint8_t {
  kGrove,
  kLibmrp,
  kPotentialGoals,
  kMgcbs,
  kMapfw,
  kScen,
};
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

// Return the format called `name` or, if `name` is empty, the format that the suffix of `file`
// implies. Throw CLI::ValidationError, which names `option`, if there is none.
InstanceFormat instance_format(const std::string& option, const std::string& name,
                               const std::string& file);
PlanFormat plan_format(const std::string& option, const std::string& name, const std::string& file);

// Returns whether an instance file of this format refers to a separate map file. In the other
// formats the instance file contains the map.
bool has_separate_map(InstanceFormat format);
// Returns whether this format can express tasks.
bool holds_tasks(InstanceFormat format);

// Returns whether `file` has the suffix of an instance format that only `grove convert` reads.
bool has_suffix_of_other_format(const std::string& file);

// Returns `file` without the suffix of its instance format ("x.cts.json" -> "x"); without its
// extension if the suffix is unknown.
std::string without_suffix(const std::string& file);

}  // namespace grove::detail
