// SPDX-License-Identifier: MIT
// The arguments by which every command names an instance.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/instance_file.h"

namespace grove::detail {

// INSTANCE.cts.json, - for standard input, or FILE.scen with --agents and optionally --map. Must
// outlive the parsing of the command line.
class InstanceArguments {
 public:
  void add_to(CLI::App& command);
  // Adds --no-following, for commands that search.
  void add_rules_to(CLI::App& command);

  // Reads the files; if `speaks`, prints warnings on standard error. Throws InputError, and
  // CLI::ValidationError if the arguments contradict each other.
  LoadedInstance load(bool speaks = true) const;

  // Name of the instance in messages and results: the path, or "standard input".
  std::string name() const;
  // "" for standard input.
  std::filesystem::path path() const { return is_standard_input() ? "" : path_; }
  // Base of names of output files: "x" of "maps/x.cts.json", "x-20" of the first 20 rows of
  // "x.scen".
  std::string stem() const;

  // Sets the limit for maps and states of instances, GB, instead of 80 % of the memory.
  void limit_memory(double gigabytes) { memory_gb_ = gigabytes; }
  InputRules rules() const;

  bool is_standard_input() const { return path_ == "-"; }
  // Sets the content of standard input for load(), because the processes of a run share one.
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

// Reads standard input to its end. Throws InputError.
std::string read_standard_input();

// Prints a line "grove: warning: ..." on standard error for each.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace grove::detail
