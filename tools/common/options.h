// SPDX-License-Identifier: MIT
// Options with numbers, checked strictly: CLI11's own conversions accept what looks like a number
// and explain little. The variables must outlive the parsing; they keep their value when the option
// is not given, and that value is shown as the default unless the option is made required.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail {

struct IntegerRange {
  std::int64_t least = 0;
  std::int64_t most = 0;
};

// Any seed.
inline constexpr IntegerRange kSeeds{0, INT64_MAX};
// Steps of a plan: a time, a delay or how long something takes.
inline constexpr IntegerRange kPlanSteps{0, 1'000'000};

CLI::Option* add_integer(CLI::App& app, const std::string& name, std::int64_t& value,
                         IntegerRange range, const std::string& description);
// "5,10,20": a list of distinct integers; no default is shown.
CLI::Option* add_integers(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                          IntegerRange range, const std::string& description);
// "1-15,20": a list of distinct integers and ranges of them. `values` keeps what it is when the
// option is not given, and `shown` is shown as that.
CLI::Option* add_ranges(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                        IntegerRange range, const std::string& shown,
                        const std::string& description);
// "10:100:10,150": a rising list of positive integers, in which 10:100:10 is from 10 to 100 in
// steps of 10.
CLI::Option* add_counts(CLI::App& app, const std::string& name, std::vector<std::int64_t>& values,
                        const std::string& description);
// An option that may be given several times, with one value each: what follows the value is no
// value of it.
CLI::Option* add_repeated(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                          const std::string& type, const std::string& description);
// The shortest text that add_ranges() reads as `values`: "1-15,20".
std::string ranges_text(const std::vector<std::int64_t>& values);
// A decimal number from `least` to `most`.
CLI::Option* add_number(CLI::App& app, const std::string& name, double& value, double least,
                        double most, const std::string& description);

// A value must be one of these.
CLI::Validator one_of(std::vector<std::string> names);

// The integer that `text` is. Throws CLI::ValidationError, naming `option`, when it is none in
// `range`.
std::int64_t parse_integer(const std::string& option, const std::string& text, IntegerRange range);

}  // namespace grove::detail
