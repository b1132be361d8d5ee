// SPDX-License-Identifier: MIT
#include "tools/common/help_formatter.h"

#include <sstream>

namespace grove::detail {
namespace {

constexpr std::size_t kDescriptionWidth = 70;

}  // namespace

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  if (option->get_description().empty()) return {};
  return CLI::Formatter::make_option(option, is_positional);
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  std::istringstream words(option->get_description());
  std::string wrapped;
  std::size_t column = 0;
  for (std::string word; words >> word; column += word.size() + 1) {
    const bool fits = column + word.size() <= kDescriptionWidth;
    if (column > 0) wrapped += fits ? ' ' : '\n';
    if (!fits) column = 0;
    wrapped += word;
  }
  return wrapped;
}

}  // namespace grove::detail
