// SPDX-License-Identifier: MIT
#include "tools/common/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

#include "model/parse_number.h"

namespace grove::detail {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& expected) {
  throw CLI::ValidationError(option, fmt::format("found '{}'; expected {}", text, expected));
}

std::string range_text(IntegerRange range) {
  return range.max == INT64_MAX ? fmt::format("an integer of at least {}", range.min)
                                : fmt::format("an integer from {} to {}", range.min, range.max);
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

// Parses one integer ("7") or a range ("3-9", both ends included).
std::vector<std::int64_t> parse_range(const std::string& option, const std::string& text,
                                      IntegerRange range) {
  const std::size_t dash = text.find('-', 1);
  const std::int64_t first = parse_integer(option, text.substr(0, dash), range);
  const std::int64_t last =
      dash == std::string::npos ? first : parse_integer(option, text.substr(dash + 1), range);
  if (first > last) refuse(option, text, "the smaller number first");
  std::vector<std::int64_t> values(static_cast<std::size_t>(last - first + 1));
  std::iota(values.begin(), values.end(), first);
  return values;
}

// Parses one integer ("7"), FIRST:LAST or FIRST:LAST:STEP ("10:100:10").
std::vector<std::int64_t> parse_steps(const std::string& option, const std::string& text) {
  constexpr IntegerRange kCounts{1, 1'000'000};
  const auto parts = CLI::detail::split(text, ':');
  if (parts.size() == 1) return {parse_integer(option, text, kCounts)};
  if (parts.size() > 3) refuse(option, text, "FIRST:LAST:STEP");
  const std::int64_t first = parse_integer(option, parts[0], kCounts);
  const std::int64_t last = parse_integer(option, parts[1], kCounts);
  const std::int64_t step = parts.size() == 3 ? parse_integer(option, parts[2], kCounts) : 1;
  if (first > last) refuse(option, text, "the smaller number first");
  std::vector<std::int64_t> values;
  for (std::int64_t value = first; value <= last; value += step) values.push_back(value);
  return values;
}

}  // namespace

std::int64_t parse_integer(const std::string& option, const std::string& text, IntegerRange range) {
  const auto value = parse_number(text, range.min, range.max);
  if (!value) refuse(option, text, range_text(range));
  return *value;
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

CLI::Option* add_ranges(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                        IntegerRange range, const std::string& shown,
                        const std::string& description) {
  const auto read = [&values, name, range](const CLI::results_t& results) {
    values.clear();
    for (const std::string& part : CLI::detail::split(results.front(), ','))
      for (const std::int64_t value : parse_range(name, part, range)) {
        if (std::ranges::count(values, value) > 0)
          refuse(name, results.front(), "distinct integers");
        values.push_back(value);
      }
    return true;
  };
  return app.add_option(name, read, description)->type_name("K-K,...")->default_str(shown);
}

CLI::Option* add_counts(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                        const std::string& description) {
  const auto read = [&values, name](const CLI::results_t& results) {
    values.clear();
    for (const std::string& part : CLI::detail::split(results.front(), ','))
      for (const std::int64_t value : parse_steps(name, part)) {
        if (!values.empty() && value <= values.back())
          refuse(name, results.front(), "increasing integers");
        values.push_back(value);
      }
    return true;
  };
  return app.add_option(name, read, description)->type_name("A:B:STEP,...");
}

CLI::Option* add_repeated(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                          const std::string& type, const std::string& description) {
  return app.add_option(name, values, description)
      ->type_name(type)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

std::string ranges_text(const std::vector<std::int64_t>& values) {
  std::string text;
  for (std::size_t first = 0, end = 0; first < values.size(); first = end) {
    do ++end;
    while (end < values.size() && values[end] == values[end - 1] + 1);
    text += fmt::format("{}{}", text.empty() ? "" : ",", values[first]);
    if (end - first > 1) text += fmt::format("-{}", values[end - 1]);
  }
  return text;
}

CLI::Validator one_of(std::vector<std::string> names) {
  return CLI::Validator(
      [names = std::move(names)](const std::string& text) {
        if (std::ranges::count(names, text) > 0) return std::string();
        return fmt::format("found '{}'; expected one of {}", text, fmt::join(names, ", "));
      },
      "");
}

CLI::Option* add_number(CLI::App& app, const std::string& name, double& value, double min,
                        double max, const std::string& description) {
  const auto read = [&value, name, min, max](const CLI::results_t& results) {
    const std::string& text = results.front();
    const auto number = parse_number(text, min, max);
    if (!number) refuse(name, text, fmt::format("a number from {} to {}", min, max));
    value = *number;
    return true;
  };
  return app.add_option(name, read, description)
      ->type_name("X")
      ->default_str(fmt::format("{}", value));
}

}  // namespace grove::detail
