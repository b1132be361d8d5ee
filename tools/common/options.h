// SPDX-License-Identifier: MIT
// Options with numbers, parsed strictly, because CLI11's own conversions accept more than numbers
// and their errors explain little. The variables must outlive the parsing. A variable keeps its
// value if the option is not given; this value is shown as the default unless the option is
// required.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail {

struct IntegerRange {
  std::int64_t min = 0;
  std::int64_t max = 0;
};

// Any seed.
inline constexpr IntegerRange kSeeds{0, INT64_MAX};
// Time steps of a plan: a time, a delay or a duration.
inline constexpr IntegerRange kPlanSteps{0, 1'000'000};

CLI::Option* add_integer(CLI::App& app, const std::string& name, std::int64_t& value,
                         IntegerRange range, const std::string& description);
// "5,10,20": a list of distinct integers. No default is shown.
CLI::Option* add_integers(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                          IntegerRange range, const std::string& description);
// "1-15,20": a list of distinct integers and ranges. `values` is unchanged if the option is not
// given; `shown` is shown as the default.
CLI::Option* add_ranges(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                        IntegerRange range, const std::string& shown,
                        const std::string& description);
// "10:100:10,150": an increasing list of positive integers; 10:100:10 is 10, 20, ..., 100.
CLI::Option* add_counts(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                        const std::string& description);
// An option that may be given several times, with exactly one value each.
CLI::Option* add_repeated(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                          const std::string& type, const std::string& description);
// Returns the shortest text that add_ranges() parses as `values`: "1-15,20".
std::string ranges_text(const std::vector<std::int64_t>& values);
// A decimal number from `min` to `max`.
CLI::Option* add_number(CLI::App& app, const std::string& name, double& value, double min,
                        double max, const std::string& description);

// Accepts only values in `names`.
CLI::Validator one_of(std::vector<std::string> names);

// Parses `text` as an integer. Throws CLI::ValidationError, which names `option`, unless it is an
// integer in `range`.
std::int64_t parse_integer(const std::string& option, const std::string& text, IntegerRange range);

}  // namespace grove::detail
