// SPDX-License-Identifier: MIT
#include "io/csv.h"

#include <algorithm>
#include <string_view>

#include "model/parse_number.h"

namespace grove::detail {
namespace {

bool is_like_a_formula(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  constexpr std::string_view kBegins = "=+-@\t\r";
  return !text.empty() && kBegins.find(text.front()) != std::string_view::npos &&
         !parse_number<double>(text);
}

}  // namespace

std::string csv_cell(const std::string& text) {
  const std::string cell = is_like_a_formula(text) ? "'" + text : text;
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace grove::detail
