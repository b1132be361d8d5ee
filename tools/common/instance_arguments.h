// SPDX-License-Identifier: MIT
// Command-line arguments that name an instance; the same for all commands.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/instance_file.h"

namespace grove::detail {

// An instance is FILE.cts.json, - for standard input, or FILE.scen with --agents and optionally
// --map. The object must outlive the parsing of the command line.
class InstanceArguments {
 public:
  void add_to(CLI::App& command);
  // Adds --no-following, for commands that search.
  void add_rules_to(CLI::App& command);

  // Reads the instance and its map. Prints warnings on standard error if `prints_messages`. Throws
  // InputError for bad files and CLI::ValidationError if the arguments contradict each other.
  LoadedInstance load(bool prints_messages = true) const;

  // Throws InputError with the place of the first choice in the file if `instance`, which load()
  // returned, has choices. `reason`, `remedy`: see refusal_text() in model/choices.h.
  void require_no_choices(const Instance& instance, std::string_view reason,
                          std::string_view remedy = "") const;

  // Returns the name of the instance for messages and results: its path, or "standard input".
  std::string name() const;
  // Returns the path of the instance file; "" for standard input.
  std::filesystem::path path() const { return is_standard_input() ? "" : path_; }
  // Returns the stem for names of output files: "x" for "maps/x.cts.json", "x-20" for the first 20
  // rows of "x.scen", "stdin" for standard input.
  std::string stem() const;

  // Sets the memory limit in GB for the map and the states of the instance. The default is
  // default_memory_gb().
  void limit_memory(double gigabytes) { memory_gb_ = gigabytes; }
  InputRules rules() const;

  bool is_standard_input() const { return path_ == "-"; }
  // Makes load() use `text` instead of reading standard input, because only one process of an MPI
  // run can read it.
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

// Adds the flag --confine; see InputRules::confined.
void add_confine_option(CLI::App& command, bool& confined);
// Returns the rules for reading instances. `memory_gb`: memory limit in GB.
InputRules input_rules(bool confined, double memory_gb);

// Reads standard input to its end. Throws InputError if it cannot be read.
std::string read_standard_input();

// Prints each warning on standard error as a line "grove: warning: ...".
void print_warnings(const std::vector<std::string>& warnings);
// Prints each hint on standard error as a line "grove: hint: ...".
void print_hints(const std::vector<std::string>& hints);

}  // namespace grove::detail
