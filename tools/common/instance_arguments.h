// SPDX-License-Identifier: MIT
// The arguments with which every command names an instance.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "grove/io/instance_file.h"

namespace grove {

// INSTANCE.cts.json, or FILE.scen with --map and --agents. Must outlive the parsing.
class InstanceArguments {
 public:
  void add_to(CLI::App& command);

  // Reads the files; prints the warnings on stderr if it `speaks`. Throws InputError, or
  // CLI::ValidationError when the arguments do not fit together.
  LoadedInstance load(bool speaks = true) const;

  const std::string& path() const { return path_; }

 private:
  LoadedInstance read() const;

  std::string path_;
  std::string map_;
  std::int64_t agents_ = 0;
};

// One "grove: warning: ..." line each, on stderr.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace grove
