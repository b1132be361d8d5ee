// SPDX-License-Identifier: MIT
// Formats fields of CSV files (RFC 4180, except that lines end with LF).
#pragma once

#include <string>

namespace grove::detail {

// Returns `text` as a CSV field, quoted if necessary. Puts an apostrophe in front of a text that a
// spreadsheet would interpret as a formula (OWASP, CSV injection), which is one that is not a
// number and begins with =, +, -, @, a tab or a CR. Also puts one in front of a text that consists
// of apostrophes followed by such a formula, so that a reader can always undo this by removing
// exactly one apostrophe.
std::string csv_cell(const std::string& text);

}  // namespace grove::detail
