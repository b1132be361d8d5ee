// SPDX-License-Identifier: MIT
// Strictly parsed numeric options. CLI11's own conversions accept more than numbers, and their
// errors explain little. The variables must outlive the parsing. A variable keeps its value if the
// option is not given. The help shows this value as the default, even if the option is required.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail {

// Inclusive at both ends.
struct IntegerRange {
  std::int64_t min = 0;
  std::int64_t max = 0;
};

// Range of random seeds.
inline constexpr IntegerRange kSeeds{0, INT64_MAX};
// Range of times, delays and durations in a plan, in time steps.
inline constexpr IntegerRange kPlanSteps{0, 1'000'000};

CLI::Option* add_integer(CLI::App& app, const std::string& name, std::int64_t& value,
                         IntegerRange range, const std::string& description);
// Adds an option whose value is a list of distinct integers, such as "5,10,20". The help shows no
// default.
CLI::Option* add_integers(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                          IntegerRange range, const std::string& description);
// Adds an option whose value is a list of integers and ranges without repetition, such as
// "1-15,20". The help shows `shown` as the default.
CLI::Option* add_ranges(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                        IntegerRange range, const std::string& shown,
                        const std::string& description);
// Adds an option whose value is an increasing list of positive integers, such as "10:100:10,150",
// where FIRST:LAST:STEP stands for FIRST, FIRST + STEP, ... up to LAST. Without :STEP the step is
// 1.
CLI::Option* add_counts(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                        const std::string& description);
// Adds an option that can be given several times, each time with exactly one value.
CLI::Option* add_repeated(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                          const std::string& type, const std::string& description);
// Returns `values` as add_ranges() parses them, with consecutive values as ranges: "1-15,20".
std::string ranges_text(const std::vector<std::int64_t>& values);
// Adds an option whose value is a decimal number from `min` to `max`.
CLI::Option* add_number(CLI::App& app, const std::string& name, double& value, double min,
                        double max, const std::string& description);

// Returns a validator that accepts only the values in `names`.
CLI::Validator one_of(std::vector<std::string> names);

// Parses `text` as an integer. Throws CLI::ValidationError, which names `option`, unless it is an
// integer in `range`.
std::int64_t parse_integer(const std::string& option, const std::string& text, IntegerRange range);

}  // namespace grove::detail
