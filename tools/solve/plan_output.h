// SPDX-License-Identifier: MIT
// What becomes of a run's plan file (design, section 5).
#pragma once

#include <filesystem>
#include <optional>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// Standard output in place of a plan file.
inline constexpr const char* kStandardOutput = "-";

// Writes what a run ended with to `file`, whole or not at all. But a file whose plan is valid for
// `instance` is left alone by a run without a plan, and by one whose plan costs more: then returns
// the cost of that plan. Of what else the file says nothing is believed, and nothing goes into what
// is written. `keeps_cheaper`: else any plan of the run is written. Throws InputError when the file
// cannot be written; std::logic_error when its plan refutes what the run claims to have proven.
std::optional<Cost> write_plan(const std::filesystem::path& file, const Instance& instance,
                               const Solution& solution, bool keeps_cheaper = true);

// Says on stderr how the run ended if it has no plan, or if the file was left alone with a plan of
// cost `kept`.
void tell_without_plan(const Solution& solution, const std::filesystem::path& file,
                       std::optional<Cost> kept);

}  // namespace grove::detail
