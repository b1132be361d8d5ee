// SPDX-License-Identifier: MIT
// Reads and writes roadmap files (docs/design.md, section 5).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/atomic_file.h"
#include "io/input_rules.h"
#include "model/roadmap.h"

namespace grove::detail {

// Reads a *.roadmap.json file. Throws InputError for invalid files and for unknown keys.
Roadmap read_roadmap(const std::filesystem::path& path, const InputRules& rules = {});
// Parses the text of such a file. `name` is the name of the file in messages.
Roadmap parse_roadmap(std::string_view text, const std::string& name, const InputRules& rules = {});

// Writes a *.roadmap.json file, atomically. Throws InputError if the file cannot be written.
void write_roadmap(const std::filesystem::path& path, const Roadmap& roadmap,
                   Durability durability = Durability::kMachine);

}  // namespace grove::detail
