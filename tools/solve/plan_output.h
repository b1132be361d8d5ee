// SPDX-License-Identifier: MIT
// Writes the plan file of a run (design, section 5).
#pragma once

#include <filesystem>
#include <optional>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// Name of a plan file that stands for standard output.
inline constexpr const char* kStandardOutput = "-";

// Writes the result of a run to `file`, completely or not at all. If `file` has a plan that is
// valid for `instance`, a run without a plan or with a plan of higher cost leaves the file
// unchanged; then returns the cost of that plan. Nothing else in the existing file is trusted or
// copied. If `keeps_cheaper` is false, any plan of the run is written. Throws InputError if the
// file cannot be written, and std::logic_error if its plan contradicts the bound that the run
// claims.
std::optional<Cost> write_plan(const std::filesystem::path& file, const Instance& instance,
                               const Solution& solution, bool keeps_cheaper = true);

// Reports on standard error how the run ended if it has no plan, or if the file was left unchanged
// with a plan of cost `kept`.
void report_missing_plan(const Solution& solution, const std::filesystem::path& file,
                         std::optional<Cost> kept);

}  // namespace grove::detail
