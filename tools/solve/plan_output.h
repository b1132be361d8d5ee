// SPDX-License-Identifier: MIT
// Writes the plan file of a run (design, section 5).
#pragma once

#include <filesystem>
#include <optional>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// The plan file name that stands for standard output.
inline constexpr const char* kStandardOutput = "-";

// Writes the result of a run to `file`, completely or not at all, or to standard output if `file`
// is "-". If `file` already contains a plan that is valid for `instance`, and the run has no plan
// or (with `keeps_cheaper`) a more expensive one, leaves the file unchanged and returns the cost of
// the existing plan; otherwise returns nullopt. Ignores everything in the existing file except its
// plan. Throws InputError if the file cannot be written, and std::logic_error if the existing valid
// plan contradicts the lower bound or the infeasibility that the run claims.
std::optional<Cost> write_plan(const std::filesystem::path& file, const Instance& instance,
                               const Solution& solution, bool keeps_cheaper = true);

// Reports on standard error how the run ended if it has no plan, or if write_plan() left the file
// unchanged and returned `kept`.
void report_missing_plan(const Solution& solution, const std::filesystem::path& file,
                         std::optional<Cost> kept);

}  // namespace grove::detail
