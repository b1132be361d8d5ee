// SPDX-License-Identifier: MIT
// Cells of CSV files (RFC 4180, except that lines end in LF).
#pragma once

#include <string>

namespace grove::detail {

// `text` as a cell, quoted if necessary. An apostrophe is added in front of a text that a
// spreadsheet would interpret as a formula (OWASP, CSV injection): one that is not a number and
// begins with =, +, -, @, a tab or a CR. A text that begins with apostrophes and one of these
// characters also gets one more, so that a reader removes exactly one.
std::string csv_cell(const std::string& text);

}  // namespace grove::detail
