// SPDX-License-Identifier: MIT
// The arguments with which every command names an instance.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/instance_file.h"

namespace grove::detail {

// INSTANCE.cts.json, - for one on standard input, or FILE.scen with --agents and perhaps --map.
// Must outlive the parsing.
class InstanceArguments {
 public:
  void add_to(CLI::App& command);
  // --no-following, of those that search.
  void add_rules_to(CLI::App& command);

  // Reads the files; prints the warnings on stderr if it `speaks`. Throws InputError, or
  // CLI::ValidationError when the arguments do not fit together.
  LoadedInstance load(bool speaks = true) const;

  // As messages and results name it: the path, or "standard input".
  std::string name() const;
  // Empty for standard input.
  std::filesystem::path path() const { return is_standard_input() ? "" : path_; }
  // For files named after it: "x" of "maps/x.cts.json", "x-20" of the first 20 rows of "x.scen".
  std::string stem() const;

  // What the maps and states of instances may take, in place of 80 % of what there is.
  void limit_memory(double gigabytes) { memory_gb_ = gigabytes; }
  InputRules rules() const;

  bool is_standard_input() const { return path_ == "-"; }
  // What load() is to take for standard input, of which all processes of a run have only one.
  void set_standard_input(std::string text) { standard_input_ = std::move(text); }

 private:
  LoadedInstance read() const;
  LoadedInstance read_first_rows() const;

  std::string path_;
  std::string map_;
  std::int64_t agents_ = 0;
  bool no_following_ = false;
  bool confined_ = false;
  std::optional<double> memory_gb_;
  std::optional<std::string> standard_input_;
};

// --confine: see InputRules.
void add_confine_option(CLI::App& command, bool& confined);
InputRules input_rules(bool confined, double memory_gb);

// All of it. Throws InputError.
std::string read_standard_input();

// One "grove: warning: ..." line each, on stderr.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace grove::detail
