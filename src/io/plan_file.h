// SPDX-License-Identifier: MIT
// Reads and writes plan files (docs/design.md, section 5).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/atomic_file.h"
#include "model/plan.h"

namespace grove::detail {

// The text that write_solution() writes. All plan files are generated here, so none contains a plan
// that the independent checker rejects: throws InvalidPlan (model/check.h). "following" is false if
// the instance or the solution forbids following.
std::string solution_text(const Instance& instance, const Solution& solution);

// Writes `solution` atomically. Throws InputError if the file cannot be written, and InvalidPlan.
void write_solution(const std::filesystem::path& path, const Instance& instance,
                    const Solution& solution, Durability outlives = Durability::kMachine);

// Reads a plan file and resolves its ids with `instance`. Does not verify its numbers; check()
// does. The agents are ordered by AgentIndex, whatever their order in the file. An agent that is
// missing in the file has an empty path. Throws InputError for invalid files, unknown keys, and
// unknown or repeated ids.
Solution read_solution(const std::filesystem::path& path, const Instance& instance);
// The same for the text of such a file. `name` stands for the file in messages.
Solution parse_solution(std::string_view text, const std::string& name, const Instance& instance);

}  // namespace grove::detail
