// SPDX-License-Identifier: MIT
// What becomes of an instance while its plan is driven, as one types it.
#pragma once

#include <string>
#include <vector>

#include "execution/change.h"
#include "execution/delay.h"
#include "io/change_file.h"

namespace grove::detail {

// Of a command line.
struct ChangeArguments {
  std::vector<std::string> late;       // ROBOT=STEPS
  std::vector<std::string> new_tasks;  // files
  std::vector<std::string> dropped;    // tasks
  std::vector<std::string> blocked;    // X,Y; or A and A,B on a roadmap
};

// Throw CLI::ValidationError, naming option and value; InputError for files.
std::vector<Delay> late_robots(const ChangeArguments& arguments, const Instance& instance);

// The change, with where each part of it was said.
class AskedChange {
 public:
  // `instance` is the one that is to be changed.
  AskedChange(const ChangeArguments& arguments, const Instance& instance);

  const InstanceChange& change() const { return change_; }
  // An error of apply() about it as one of the command line, or of a file.
  [[noreturn]] void refuse(const InstanceError& error) const;

 private:
  void read_new_tasks(const std::string& file, const Instance& instance);
  void block(const std::string& text, const Instance& instance);
  void block_on_roadmap(const std::string& text, const Roadmap& roadmap);

  InstanceChange change_;
  struct Said {
    std::string where;  // file or option
    std::string what;   // place in the file, or the option's value
  };
  std::vector<Said> new_tasks_, dropped_, blocked_, closed_roads_;  // as in the change
};

}  // namespace grove::detail
