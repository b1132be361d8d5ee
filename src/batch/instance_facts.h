// SPDX-License-Identifier: MIT
// What the rows of a table say of an instance, so that they can be grouped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "batch/entry.h"

namespace grove::detail::batch {

struct InstanceFacts {
  std::string map;                            // the file's name without .map
  std::optional<std::int64_t> scenario = {};  // as its name says
  std::int64_t agents = 0;
  std::int64_t tasks = 0;
  std::string problem;  // cts, mg, mapf, mixed

  friend bool operator==(const InstanceFacts&, const InstanceFacts&) = default;
};

// The scenario is the number in an id such as room_s3_n5_m20_mg or den312d-random-3-50, none in
// others. The tasks are that name's M where it has one: an MG-MAPF instance of the paper has M
// tasks and one more where a destination was. Else all tasks are counted.
InstanceFacts facts_of(const Entry& entry, const LoadedInstance& loaded);

}  // namespace grove::detail::batch
