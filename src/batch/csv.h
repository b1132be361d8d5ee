// SPDX-License-Identifier: MIT
// Cells of CSV files (RFC 4180, but lines end in LF).
#pragma once

#include <string>

namespace grove::detail::batch {

// `text` as a cell: in quotes where it must be.
std::string csv_quoted(const std::string& text);

}  // namespace grove::detail::batch
