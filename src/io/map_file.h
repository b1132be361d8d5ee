// SPDX-License-Identifier: MIT
// Reads and writes Moving AI maps (https://movingai.com/benchmarks/formats.html).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/grid.h"

namespace grove::detail {

// The maximum number of cells of a map: 2^26, for example 8192 x 8192.
inline constexpr int kMaxMapCells = 1 << 26;

// Reads a .map file: four header lines (type octile, height, width, map; height and width in either
// order), then `height` rows of `width` characters. Passable: . G S E. Blocked: @ O T W. CRLF line
// ends are accepted, and the last line end may be missing. Throws InputError with line and column
// for any other content, except for empty lines at the end. Appends one warning to `warnings`,
// unless it is nullptr, if there are valid characters other than . @ T.
Grid read_map(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr,
              const InputRules& rules = {});

// Writes `grid` as a .map file with '.' and '@', atomically. Throws InputError if the file cannot
// be written.
void write_map(const std::filesystem::path& path, const Grid& grid);

// Writes `grid` with a border of blocked cells, atomically: a line with the numbers of rows and
// columns, then the rows, with 1 for a blocked cell and 0 for a passable one. Commas separate all
// numbers. Throws InputError if the file cannot be written.
void write_bordered_csv(const std::filesystem::path& path, const Grid& grid);

}  // namespace grove::detail
