// SPDX-License-Identifier: MIT
#include "options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace grove {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& expected) {
  throw CLI::ValidationError(option, fmt::format("found '{}'; expected {}", text, expected));
}

// True if all of `text` is a number, which is then in `value`.
template <typename Number>
bool parse_all(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [parsed_to, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && parsed_to == end;
}

std::string range_text(IntegerRange range) {
  return range.most == INT64_MAX ? fmt::format("an integer of at least {}", range.least)
                                 : fmt::format("an integer from {} to {}", range.least, range.most);
}

std::vector<std::int64_t> parse_integers(const std::string& option, const std::string& text,
                                         IntegerRange range) {
  std::vector<std::int64_t> values;
  for (const std::string& part : CLI::detail::split(text, ',')) {
    values.push_back(parse_integer(option, part, range));
    if (std::ranges::count(values, values.back()) > 1) refuse(option, text, "distinct integers");
  }
  return values;
}

}  // namespace

std::int64_t parse_integer(const std::string& option, const std::string& text, IntegerRange range) {
  std::int64_t value = 0;
  if (!parse_all(text, value) || value < range.least || value > range.most)
    refuse(option, text, range_text(range));
  return value;
}

CLI::Option* add_integer(CLI::App& app, const std::string& name, std::int64_t& value,
                         IntegerRange range, const std::string& description) {
  const auto read = [&value, name, range](const CLI::results_t& results) {
    value = parse_integer(name, results.front(), range);
    return true;
  };
  return app.add_option(name, read, description)
      ->type_name("N")
      ->default_str(std::to_string(value));
}

CLI::Option* add_integers(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                          IntegerRange range, const std::string& description) {
  const auto read = [&values, name, range](const CLI::results_t& results) {
    values = parse_integers(name, results.front(), range);
    return true;
  };
  return app.add_option(name, read, description)->type_name("N,N,...");
}

CLI::Option* add_number(CLI::App& app, const std::string& name, double& value, double least,
                        double most, const std::string& description) {
  const auto read = [&value, name, least, most](const CLI::results_t& results) {
    const std::string& text = results.front();
    if (!parse_all(text, value) || !(value >= least && value <= most))
      refuse(name, text, fmt::format("a number from {} to {}", least, most));
    return true;
  };
  return app.add_option(name, read, description)
      ->type_name("X")
      ->default_str(fmt::format("{}", value));
}

}  // namespace grove
