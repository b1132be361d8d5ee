// SPDX-License-Identifier: MIT
// Moving AI maps (https://movingai.com/benchmarks/formats.html), read strictly.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/grid.h"

namespace grove::detail {

// The maximum number of cells of a map: about 8192 x 8192.
inline constexpr int kMaxMapCells = 1 << 26;

// Reads a .map file: four header lines (type octile, height, width, map; height and width in either
// order), then `height` rows of `width` characters. Passable: . G S E. Blocked: @ O T W. CRLF line
// ends and a missing last line end are accepted. Appends to `warnings` if there are characters
// other than . @ T. Throws InputError with line and column for any other content.
Grid read_map(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr,
              const InputRules& rules = {});

// Writes `grid` with '.' and '@', atomically. Throws InputError if it cannot.
void write_map(const std::filesystem::path& path, const Grid& grid);

}  // namespace grove::detail
