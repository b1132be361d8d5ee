// SPDX-License-Identifier: MIT
// Properties of an instance by which the rows of a result table are grouped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "batch/entry.h"

namespace grove::detail::batch {

struct InstanceMetadata {
  std::string map;                            // name of the map file without its suffix
  std::optional<std::int64_t> scenario = {};  // from the id of the instance
  std::int64_t agents = 0;
  std::int64_t tasks = 0;
  std::string problem;  // "cts", "mg", "mapf", "mixed" or "choices"

  friend bool operator==(const InstanceMetadata&, const InstanceMetadata&) = default;
};

// Determines the properties. The scenario is the number in an id such as room_s3_n5_m20_mg or
// den312d-random-3-50; other ids have none. If the id contains _sS_nN_mM, as in the first example,
// the number of tasks is M, because an MG-MAPF instance of the paper has M tasks plus one for each
// former destination. Otherwise all tasks are counted.
InstanceMetadata metadata_of(const Entry& entry, const LoadedInstance& loaded);

}  // namespace grove::detail::batch
