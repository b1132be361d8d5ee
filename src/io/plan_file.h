// SPDX-License-Identifier: MIT
// Plan files (docs/design.md, section 5).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/atomic_file.h"
#include "model/plan.h"

namespace grove::detail {

// What write_solution() writes. All plan files are made here, so no plan gets into one that the
// independent checker refuses: throws InvalidPlan (model/check.h). "following" is false if the
// instance forbids it or the solution claims so.
std::string solution_text(const Instance& instance, const Solution& solution);

// Writes `solution` whole or not at all. Throws InputError when the file cannot be written, and
// InvalidPlan.
void write_solution(const std::filesystem::path& path, const Instance& instance,
                    const Solution& solution, Durability outlives = Durability::kMachine);

// Reads a plan file and translates its ids with `instance`; believes every number it finds, for
// check() to refute. Agents come back by AgentIndex whatever their order in the file; an agent that
// the file leaves out has an empty path. Throws InputError on malformed files, unknown keys, and
// unknown or repeated ids.
Solution read_solution(const std::filesystem::path& path, const Instance& instance);
// The same of the text of such a file: `name` stands for it in messages.
Solution parse_solution(std::string_view text, const std::string& name, const Instance& instance);

}  // namespace grove::detail
