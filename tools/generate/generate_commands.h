// SPDX-License-Identifier: MIT
// The subcommands of `grove generate`.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <string>

#include "model/grid.h"
#include "tools/common/options.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {

inline constexpr IntegerRange kAgentNumbers{1, 100'000};
inline constexpr IntegerRange kScenarioNumbers{1, 10'000};
inline constexpr IntegerRange kTaskNumbers{0, 1'000'000};

void add_generate_map_command(CLI::App& generate);
void add_generate_roadmap_command(CLI::App& generate);
void add_generate_scenario_command(CLI::App& generate);
void add_generate_instance_command(CLI::App& generate);
void add_generate_dataset_command(CLI::App& generate);
void add_generate_paper_command(CLI::App& generate);

// Adds the required option --output, whose value has the type name `type_name` in the help.
void add_output(CLI::App& command, std::string& path, const std::string& type_name);

// Reads a map file and prints its warnings.
Grid load_map(const std::string& map);

// Reads all rows of a scenario file. Throws InputError if they are not for the map at `map`, which
// has the content `grid`.
Scenario load_scenario(const std::string& file, const std::string& map, const Grid& grid);

// Draws a random scenario for `map` with the number of rows that `request` needs.
Scenario draw_scenario(const std::string& map, const Grid& grid, const InstanceRequest& request,
                       std::int64_t seed);

// Returns the path of `map` relative to the folder of the instance file `instance`, as that file
// must name it.
std::string map_as_seen_from(const std::filesystem::path& instance, const std::string& map);

}  // namespace grove::detail
