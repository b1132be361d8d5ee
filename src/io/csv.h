// SPDX-License-Identifier: MIT
// Cells of CSV files (RFC 4180, but lines end in LF).
#pragma once

#include <string>

namespace grove::detail {

// `text` as a cell: in quotes where it must be, and behind an apostrophe where a spreadsheet would
// take it for a formula (OWASP, CSV injection): where it is no number and begins with =, +, -, @, a
// tab or a CR. A text that begins with apostrophes and one of these gets one more, so that a reader
// takes exactly one away.
std::string csv_cell(const std::string& text);

}  // namespace grove::detail
